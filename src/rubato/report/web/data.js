// SPDX-License-Identifier: LGPL-3.0-or-later
// The arrays of the report, from text: base64, zlib, planes of bytes, differences (report/packing.hpp).
"use strict";
window.rubato = { marks: { scripts: performance.now() } };
(function (R) {
  const kept = new Map(); // decoded arrays, the one that was used last at the end
  const mostBytes = 2e8;
  let keptBytes = 0;

  function bytesOf(text) {
    if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
    const letters = atob(text);
    const bytes = new Uint8Array(letters.length);
    for (let i = 0; i < letters.length; ++i) bytes[i] = letters.charCodeAt(i);
    return bytes;
  }

  async function inflated(bytes) {
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
  }

  /** Undoes planes and differences: `Type` is Uint16Array or Uint32Array. */
  R.unpacked = function (bytes, Type) {
    const width = Type.BYTES_PER_ELEMENT, count = bytes.length / width;
    const numbers = new Type(count);
    let sum = 0;
    for (let i = 0; i < count; ++i) {
      let difference = 0;
      for (let plane = 0; plane < width; ++plane) difference |= bytes[plane * count + i] << (8 * plane);
      sum = (sum + difference) | 0;
      numbers[i] = sum;
    }
    return numbers;
  };

  async function decoded(name, Type) {
    const element = document.getElementById(name);
    if (!element) throw new Error("the report holds no array " + name);
    const bytes = await inflated(bytesOf(element.textContent.trim()));
    if (Type === Float32Array) return new Float32Array(R.unpacked(bytes, Uint32Array).buffer);
    return R.unpacked(bytes, Type);
  }

  /** Decodes an array of the page; what was used last is kept. */
  R.array = function (name, Type) {
    let entry = kept.get(name);
    if (entry) {
      kept.delete(name);
    } else {
      entry = { promise: decoded(name, Type), bytes: 0 };
      entry.promise.then((numbers) => {
        entry.bytes = numbers.byteLength;
        keptBytes += entry.bytes;
        for (const [other, old] of kept) {
          if (keptBytes <= mostBytes || old === entry) break;
          kept.delete(other);
          keptBytes -= old.bytes;
        }
      });
    }
    kept.set(name, entry);
    return entry.promise;
  };

  /** Decodes an array without keeping it. */
  R.arrayOnce = (name, Type) => (kept.has(name) ? kept.get(name).promise : decoded(name, Type));

  const notANumber = 0xffff;

  /** Component `c` of a packed field as real numbers, NaN where there is none. */
  R.component = function (numbers, c, range, count) {
    const values = new Float32Array(count);
    const [least, step] = range;
    for (let i = 0, at = c * count; i < count; ++i, ++at)
      values[i] = numbers[at] === notANumber ? NaN : least + step * numbers[at];
    return values;
  };

  /** One node's value, in full precision. */
  R.valueOf = function (numbers, c, range, count, node) {
    const number = numbers[c * count + node];
    return number === notANumber ? NaN : range[0] + range[1] * number;
  };

  R.data = JSON.parse(document.getElementById("report-data").textContent);
})(window.rubato);
