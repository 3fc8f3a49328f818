// SPDX-License-Identifier: MIT

/** Returns a function that asks for the work in the next picture: once, however often it is called until then. */
export function oncePerFrame(work: () => void): () => void {
  let asked = false;
  return () => {
    if (asked) return;
    asked = true;
    requestAnimationFrame(() => {
      asked = false;
      work();
    });
  };
}

/** Does the work when the picture of this moment is on its way to the screen: what takes long does not hold it up. */
export function afterPicture(work: () => void): void {
  requestAnimationFrame(() => setTimeout(work));
}
