// SPDX-License-Identifier: Apache-2.0

/**
 * Compiles and instantiates a WebAssembly module that imports nothing. Compiles while loading where the host sends
 * `application/wasm`, else after loading. Errors name the file.
 */
export async function loadWasm(url: string): Promise<WebAssembly.Exports> {
  const response = await fetch(url);
  if (!response.ok) throw new Error(`${url}: the server answers ${response.status}`);
  const streams = response.headers.get('Content-Type')?.startsWith('application/wasm') ?? false;
  const module = streams ? WebAssembly.compileStreaming(response) : WebAssembly.compile(await response.arrayBuffer());
  const { exports } = await WebAssembly.instantiate(await module, {});
  (exports['_initialize'] as (() => void) | undefined)?.();
  return exports;
}
