// SPDX-License-Identifier: Apache-2.0

/** Seconds over which the rate is taken. */
const WINDOW = 2;

/** The rate at which a count grows, over the last two seconds. */
export class RateMeter {
  #samples: [time: number, count: number][] = [];

  add(time: number, count: number): void {
    this.#samples.push([time, count]);
    while (this.#samples.length > 2 && this.#samples[0]![0] < time - WINDOW) this.#samples.shift();
  }

  /** Counts a second, 0 before two samples. */
  value(): number {
    const first = this.#samples[0];
    const last = this.#samples.at(-1);
    if (first === undefined || last === undefined || last[0] === first[0]) return 0;
    return (last[1] - first[1]) / (last[0] - first[0]);
  }
}
