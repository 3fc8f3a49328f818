// SPDX-License-Identifier: MIT
// The first visit of the page without an engine: it begins with the film, and until there is a part to show, with a picture of it.

import { afterPicture } from "@tribo/ui/frame";
import { recall, remember } from "../page.js";

const SEEN = "film";
const FADE_MS = 500;
// The page begins without the picture where that takes longer, or where nobody sees the window.
const PATIENCE_MS = 2000;

/** Motion is not wanted. */
export const isStill = (): boolean => matchMedia("(prefers-reduced-motion: reduce)").matches;

let isDeclined = false;

/** The film was not begun before, may move, and the visitor did not turn to something else. */
export const isFilmNew = (): boolean => recall(SEEN) === "" && !isStill() && !isDeclined;
export const rememberFilm = (): void => remember(SEEN, "seen");

const poster = () => document.getElementById("poster");

/** Shows the picture of the first example's part, as the film will begin; a link opens another job. Waits until it is drawn, but not for long. */
export async function showPoster(): Promise<void> {
  const picture = poster();
  if (!picture || !isFilmNew() || location.hash !== "") return hidePoster();
  document.body.dataset.film = "prelude";
  picture.hidden = false;
  const drawn = async () => {
    await picture.querySelector("img")!.decode();
    await new Promise<void>((done) => afterPicture(done));
    return true;
  };
  const patience = new Promise<boolean>((done) => setTimeout(() => done(false), PATIENCE_MS));
  if (!(await Promise.race([drawn().catch(() => false), patience]))) withoutPoster();
}

/** The page as it is without film and picture. */
export function withoutPoster(): void {
  hidePoster();
  delete document.body.dataset.film;
}

/** The visitor does something else before the film begins: this visit goes on without it. */
export function declineFilm(): void {
  isDeclined = true;
  withoutPoster();
}

/** Ends it, at once or with a fade. */
export function hidePoster(fades = false): void {
  const picture = poster();
  if (!picture) return;
  picture.id = "";
  picture.classList.add("poster-fades");
  setTimeout(() => picture.remove(), fades ? FADE_MS : 0);
}
