// Runs a WebAssembly program of tests, as Cargo's runner: node run.mjs PROGRAM [ARGUMENT...]
import { readFile } from "node:fs/promises";
import process from "node:process";
import { setFlagsFromString } from "node:v8";
import { WASI } from "node:wasi";

// While a long call into WebAssembly runs, the V8 of Node 20 throws away the bytecode of the function that made the call,
// and crashes (SIGSEGV, SIGTRAP) when the call returns to it.
setFlagsFromString("--no-flush-bytecode");

const [program, ...rest] = process.argv.slice(2);
const wasi = new WASI({ version: "preview1", args: [program, ...rest], env: process.env, preopens: { "/": "/" }, returnOnExit: true });
const module = await WebAssembly.compile(await readFile(program));
process.exitCode = wasi.start(await WebAssembly.instantiate(module, wasi.getImportObject()));
