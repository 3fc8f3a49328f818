// SPDX-License-Identifier: MIT
// Reads sound files: WAV sample by sample at its own rate; the browser decodes other formats. Of several channels the
// loudest is used, as in `tribo learn`.

export interface Sound {
  rate: number;
  samples: Float64Array;
  channels: number;
  /** Bits per sample; 0: not integers. */
  bits: number;
}

const kLeastHz = 4000;
const kMostHz = 384_000;
export const kLongestS = 300;

function loudest(channels: Float64Array[]): Float64Array {
  const energies = channels.map((x) => x.reduce((sum, v) => sum + v * v, 0));
  return channels[energies.indexOf(Math.max(...energies))] ?? channels[0]!;
}

/** Returns one sample at a byte position, full scale 1. */
function reader(view: DataView, floating: boolean, bytes: number): ((at: number) => number) | undefined {
  if (floating) {
    if (bytes === 4) return (at) => view.getFloat32(at, true);
    return bytes === 8 ? (at) => view.getFloat64(at, true) : undefined;
  }
  if (bytes === 1) return (at) => (view.getUint8(at) - 128) / 128;
  if (bytes === 2) return (at) => view.getInt16(at, true) / 32768;
  if (bytes === 3) return (at) => (view.getUint8(at) + 256 * view.getInt16(at + 1, true)) / 8388608;
  return bytes === 4 ? (at) => view.getInt32(at, true) / 2147483648 : undefined;
}

/** Reads a RIFF WAV file, PCM or floating point. A truncated file is read to its end. */
export function readWav(bytes: ArrayBuffer): Sound {
  const view = new DataView(bytes);
  const word = (at: number) => String.fromCharCode(...new Uint8Array(bytes, at, 4));
  let rate = 0;
  let channels = 0;
  let bits = 0;
  let format = 0;
  for (let at = 12; at + 8 <= bytes.byteLength;) {
    const kind = word(at);
    const length = view.getUint32(at + 4, true);
    const from = at + 8;
    if (kind === "fmt " && from + 16 <= bytes.byteLength) {
      format = view.getUint16(from, true);
      channels = view.getUint16(from + 2, true);
      rate = view.getUint32(from + 4, true);
      bits = view.getUint16(from + 14, true);
      // The extensible format has the real format in its GUID.
      if (format === 0xfffe && length >= 40 && from + 26 <= bytes.byteLength) format = view.getUint16(from + 24, true);
    } else if (kind === "data") {
      const size = bits / 8;
      const read = format === 1 || format === 3 ? reader(view, format === 3, size) : undefined;
      if (read === undefined || channels < 1 || channels > 64)
        throw new Error(`is a WAV of a kind that is not read (format ${format}, ${bits} bits); give 16 or 24 bit PCM`);
      if (!(rate >= kLeastHz && rate <= kMostHz))
        throw new Error(`has a sample rate of ${rate} Hz; give ${kLeastHz} to ${kMostHz}`);
      const frames = Math.floor(Math.min(length, bytes.byteLength - from) / (size * channels));
      if (frames > kLongestS * rate) throw new Error(`is longer than ${kLongestS / 60} minutes; some seconds will do`);
      const all = Array.from({ length: channels }, () => new Float64Array(frames));
      all.forEach((samples, c) => {
        for (let n = 0; n < frames; ++n) samples[n] = read(from + size * (n * channels + c));
      });
      return { rate, channels, bits: format === 1 ? bits : 0, samples: loudest(all) };
    }
    at = from + length + (length & 1);
  }
  throw new Error("is a WAV file without sound in it; record it anew");
}

/** Reads any sound file. Throws an Error that explains the problem. */
export async function readSound(file: Blob): Promise<Sound> {
  const bytes = await file.arrayBuffer();
  const head = new Uint8Array(bytes, 0, Math.min(32, bytes.byteLength));
  if (bytes.byteLength === 0) throw new Error("is empty; give a recording of friction");
  const name = String.fromCharCode(...head);
  if (name.startsWith("RIFF") && name.startsWith("WAVE", 8)) return readWav(bytes);
  // The browser resamples to the rate of the context; use the rate of the file if its header is known.
  const flac =
    name.startsWith("fLaC") && head.length >= 21 ? (head[18]! << 12) | (head[19]! << 4) | (head[20]! >> 4) : 0;
  const rate = flac >= 8000 && flac <= 96000 ? flac : 48000;
  let decoded: AudioBuffer;
  try {
    decoded = await new OfflineAudioContext(1, 1, rate).decodeAudioData(bytes);
  } catch {
    throw new Error("is no sound that this browser can read; give WAV or FLAC");
  }
  if (decoded.duration > kLongestS) throw new Error(`is longer than ${kLongestS / 60} minutes; some seconds will do`);
  const all = Array.from({ length: decoded.numberOfChannels }, (_, c) => Float64Array.from(decoded.getChannelData(c)));
  return { rate, channels: all.length, bits: 0, samples: loudest(all) };
}
