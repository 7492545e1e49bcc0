/** Work on the newest input only: while one is worked on, others may come and replace each other, and only the last of them is next. */
export class Latest<T> {
  #work: (input: T, isNewest: () => boolean) => Promise<void>;
  #next: { input: T } | null = null;
  #isWorking = false;
  #onWorking: (isWorking: boolean) => void;
  #onStale: () => void;

  /** `onWorking` is told when there begins to be work, and when all is done; `onStale` when what is worked on is the newest no more. */
  constructor(
    work: (input: T, isNewest: () => boolean) => Promise<void>,
    onWorking: (isWorking: boolean) => void = () => {},
    onStale: () => void = () => {},
  ) {
    this.#work = work;
    this.#onWorking = onWorking;
    this.#onStale = onStale;
  }

  /** Takes an input; what waited is dropped. */
  take(input: T): void {
    this.#next = { input };
    if (this.#isWorking) this.#onStale();
    else void this.#run();
  }

  async #run(): Promise<void> {
    this.#isWorking = true;
    this.#onWorking(true);
    while (this.#next) {
      const { input } = this.#next;
      this.#next = null;
      await this.#work(input, () => this.#next === null);
    }
    this.#isWorking = false;
    this.#onWorking(false);
  }
}
