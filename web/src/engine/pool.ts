/** Workers with a core each, and the questions that wait for them. */

import type { Answer, CoreModule, Question } from './messages';
import { EngineError, type Language, type Problem } from './types';
import CoreWorker from './worker?worker&inline';

/** A pointless answer that has not come after this time, in ms, is not waited for. */
const PATIENCE = 1500;

interface Waiting {
  question: Question;
  transfer: Transferable[];
  resolve: (value: unknown) => void;
  reject: (error: Error) => void;
}

/** A worker, which is asked one question at a time. */
export class CoreClient {
  #worker: Worker;
  #module: CoreModule;
  #language: Language;
  /** The files that a core is given when it starts, by name. */
  readonly #files: ReadonlyMap<string, Uint8Array>;
  #queue: Waiting[] = [];
  #current: (Waiting & { id: number; since: number }) | null = null;
  #next = 0;
  /** Why there is no core any more: it did not start. */
  #failure: string | null = null;
  /** The version of the core, once it has started. */
  readonly started: Promise<string>;
  #tellStarted!: (version: string) => void;
  #tellFailed!: (error: Error) => void;

  constructor(module: CoreModule, language: Language, files: ReadonlyMap<string, Uint8Array>) {
    this.#files = files;
    this.#module = module;
    this.#language = language;
    this.started = new Promise((resolve, reject) => {
      this.#tellStarted = resolve;
      this.#tellFailed = reject;
    });
    // Whoever needs to know asks; all others learn it by their questions.
    this.started.catch(() => {});
    this.#worker = this.#start();
  }

  get isIdle(): boolean {
    return this.#current === null && this.#queue.length === 0;
  }

  setLanguage(language: Language): void {
    this.#language = language;
    void this.ask({ kind: 'language', language });
  }

  ask<T>(question: Question, transfer: Transferable[] = []): Promise<T> {
    return new Promise<T>((resolve, reject) => {
      if (this.#failure !== null) {
        reject(new EngineError(this.#failure, [], 'lost'));
        return;
      }
      this.#queue.push({ question, transfer, resolve: resolve as (value: unknown) => void, reject });
      this.#send();
    });
  }

  /** Nobody waits for the answers to such questions: they are not asked, and a worker that goes on with one is replaced. */
  abandon(isPointless: (question: Question) => boolean): void {
    const error = new EngineError('a newer question came', [], 'pointless');
    const pointless = this.#queue.filter((waiting) => isPointless(waiting.question));
    this.#queue = this.#queue.filter((waiting) => !isPointless(waiting.question));
    for (const waiting of pointless) waiting.reject(error);
    const current = this.#current;
    if (!current || !isPointless(current.question)) return;
    setTimeout(
      () => {
        if (this.#current === current) this.#replace(error);
      },
      Math.max(0, current.since + PATIENCE - performance.now()),
    );
  }

  #start(): Worker {
    const worker = new CoreWorker();
    worker.onmessage = ({ data }: MessageEvent<Answer>) => this.#take(data);
    worker.onmessageerror = () => this.#fail('the worker did not understand');
    worker.onerror = (event) => {
      event.preventDefault();
      this.#fail(event.message || 'the worker stopped');
    };
    // Answered like any question, but before all others.
    const start: Waiting = {
      question: { kind: 'start', module: this.#module },
      transfer: [],
      resolve: (version) => this.#tellStarted(version as string),
      reject: this.#tellFailed,
    };
    const told = (question: Question): Waiting => ({ question, transfer: [], resolve: () => {}, reject: () => {} });
    const files = [...this.#files].map(([name, content]) => told({ kind: 'file', name, content }));
    this.#queue.unshift(start, told({ kind: 'language', language: this.#language }), ...files);
    // The first message is sent once the field #worker is set.
    queueMicrotask(() => this.#send());
    return worker;
  }

  #send(): void {
    if (this.#current) return;
    const next = this.#queue.shift();
    if (!next) return;
    const id = this.#next++;
    this.#current = { ...next, id, since: performance.now() };
    this.#worker.postMessage({ id, question: next.question }, next.transfer);
  }

  #take(answer: Answer): void {
    const current = this.#current;
    if (current?.id !== answer.id) return;
    if (answer.fatal) {
      this.#fail(answer.error ?? '');
      return;
    }
    this.#current = null;
    if (answer.error !== null) {
      current.reject(new EngineError(answer.error));
    } else if (isInvalid(answer.value)) {
      current.reject(new EngineError('the scene is not valid', answer.value.invalid));
    } else {
      current.resolve(answer.value);
    }
    this.#send();
  }

  /** A worker that stopped is replaced; its question is not asked again, because it may be the cause. */
  #fail(reason: string): void {
    const error = new EngineError(reason, [], 'lost');
    if (this.#current?.question.kind !== 'start') {
      this.#replace(error);
      return;
    }
    // Another one would not start either.
    this.#worker.terminate();
    this.#current.reject(error);
    this.#current = null;
    this.#failure = reason;
    for (const waiting of this.#queue) waiting.reject(error);
    this.#queue = [];
  }

  #replace(error: EngineError): void {
    this.#worker.terminate();
    this.#current?.reject(error);
    this.#current = null;
    this.#worker = this.#start();
  }
}

function isInvalid(value: unknown): value is { invalid: Problem[] } {
  return typeof value === 'object' && value !== null && 'invalid' in value;
}
