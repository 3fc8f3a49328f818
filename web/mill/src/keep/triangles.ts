// SPDX-License-Identifier: MIT

/** A piece of the surface of the part: triangles by three indices each; positions in mm. */
export interface Triangles {
  positions: ArrayLike<number>;
  indices: ArrayLike<number>;
  /** Of each vertex: not 0 on the surface of the blank. A triangle of them alone is untouched. */
  onBlank: ArrayLike<number>;
}
