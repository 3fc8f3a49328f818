// SPDX-License-Identifier: MIT
// The properties of <tribo-touch> that mirror its attributes.
import type { Material } from "./material.js";
import { kFields } from "./material_schema.js";

// On a server there is no HTMLElement; the class is never instantiated there.
// oxlint-disable-next-line typescript/no-extraneous-class -- it stands in for HTMLElement
const Base = typeof HTMLElement === "undefined" ? (class {} as typeof HTMLElement) : HTMLElement;

export abstract class AttributeElement extends Base {
  abstract readonly material: Material | undefined;

  get src(): string {
    return this.getAttribute("src") ?? "";
  }
  set src(value: string) {
    this.setAttribute("src", value);
  }
  get alt(): string {
    return this.getAttribute("alt") ?? "";
  }
  set alt(value: string) {
    this.setAttribute("alt", value);
  }
  get poster(): string {
    return this.getAttribute("poster") ?? "";
  }
  set poster(value: string) {
    this.setAttribute("poster", value);
  }
  get loading(): string {
    return this.getAttribute("loading") ?? "auto";
  }
  set loading(value: string) {
    this.setAttribute("loading", value);
  }
  get reveal(): string {
    return this.getAttribute("reveal") ?? "auto";
  }
  set reveal(value: string) {
    this.setAttribute("reveal", value);
  }
  get disabled(): boolean {
    return this.hasAttribute("disabled");
  }
  set disabled(value: boolean) {
    this.toggleAttribute("disabled", value);
  }
  get muted(): boolean {
    return this.hasAttribute("muted");
  }
  set muted(value: boolean) {
    this.toggleAttribute("muted", value);
  }
  get asPublished(): boolean {
    return this.hasAttribute("as-published");
  }
  set asPublished(value: boolean) {
    this.toggleAttribute("as-published", value);
  }
  /** K in N/mm: from the attribute, else from the material. */
  get stiffness(): number {
    return this.#number("stiffness", "stiffness_n_per_mm") ?? this.material?.stiffness_n_per_mm ?? Number.NaN;
  }
  set stiffness(value: number) {
    this.setAttribute("stiffness", String(value));
  }
  /** nu in N s/mm: from the attribute, else from the material. */
  get damping(): number {
    return this.#number("damping", "viscosity_n_s_per_mm") ?? this.material?.viscosity_n_s_per_mm ?? Number.NaN;
  }
  set damping(value: number) {
    this.setAttribute("damping", String(value));
  }

  #number(name: string, key: keyof Material): number | undefined {
    const value = Number(this.getAttribute(name) ?? Number.NaN);
    const { from, to } = kFields[key]!;
    return value >= from! && value <= to! ? value : undefined;
  }
}
