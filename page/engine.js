"use strict";

// The engine in a worker or in node: makeEngine(bytes of engine.wasm) returns a function from a question to its answer, both
// as page/engine/engine.cpp describes them.
async function makeEngine(bytes) {
  let memory;
  const view = () => new DataView(memory.buffer), nothing = () => 0, refused = () => 52;  // 52: not supported
  // Of a system the engine gets only what begins and ends it: no files, no clock that could change numbers.
  const system = {
    proc_exit(code) { throw new Error(`the engine ended with ${code}`); },
    environ_sizes_get(count, size) { view().setUint32(count, 0, true); view().setUint32(size, 0, true); return 0; },
    environ_get: nothing,
    clock_time_get(_, __, time) { view().setBigUint64(time, 0n, true); return 0; },
    fd_close: nothing,
  };
  const module = await WebAssembly.compile(bytes), imports = {};
  for (const { module: from, name } of WebAssembly.Module.imports(module)) (imports[from] ??= {})[name] = system[name] ?? refused;
  const { exports } = await WebAssembly.instantiate(module, imports);
  memory = exports.memory;
  exports._initialize();
  return (question) => {
    const text = new TextEncoder().encode(JSON.stringify(question) + "\0"), at = exports.malloc(text.length);
    new Uint8Array(memory.buffer, at, text.length).set(text);
    const answer = exports.bristle_answer(at), all = new Uint8Array(memory.buffer, answer);
    const found = JSON.parse(new TextDecoder().decode(all.slice(0, all.indexOf(0))));
    exports.free(at);
    exports.free(answer);
    return found;
  };
}
