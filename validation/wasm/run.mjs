// Runs a program of tests for a browser's WebAssembly, as Cargo's runner: node run.mjs PROGRAM. SEED repeats a failure.
import { readFile } from "node:fs/promises";
import process from "node:process";
import { setFlagsFromString } from "node:v8";

// While a long call into WebAssembly runs, the V8 of Node 20 throws away the bytecode of the function that made the call,
// and crashes (SIGSEGV, SIGTRAP) when the call returns to it.
setFlagsFromString("--no-flush-bytecode");

const module = await WebAssembly.compile(await readFile(process.argv[2]));
let memory;
const show = (start, length) => console.error(new TextDecoder().decode(new Uint8Array(memory.buffer, start >>> 0, length >>> 0)));
// Every test of random scenes asks for one: so it is known that tests ran, of which nothing else is heard.
let seeds = 0;
const random = () => {
  seeds += 1;
  return Number(process.env.SEED ?? Math.random());
};
const missing = (name) => () => { throw new Error(`a test has no ${name}`); };
// What wasm-bindgen would provide; tests need no more.
const provided = (name) =>
  name.startsWith("__wbg_error_") ? show : name.startsWith("__wbg_random_") ? random : missing(name);
const imports = {};
for (const { module: from, name } of WebAssembly.Module.imports(module)) (imports[from] ??= {})[name] = provided(name);
const { exports } = await WebAssembly.instantiate(module, imports);
memory = exports.memory;
process.exitCode = exports.main(0, 0) || (seeds > 0 ? 0 : 1);
console.log(process.exitCode ? "a test failed, or none ran" : "all tests passed");
