// Says what is being built: which step of how many, what is still at work, and how long each took. Steps may run at once.

/** Steps that take longer are told to be still at work, each time that so many milliseconds have passed. */
const REMINDER_MILLISECONDS = 20_000;

const seconds = (start) => `${((performance.now() - start) / 1000).toFixed(1)} s`;

export class Steps {
  #count;
  #started = 0;
  #start = performance.now();

  constructor(count) {
    this.#count = count;
  }

  /** Does some work, and gives what it gives. */
  async run(what, work) {
    const step = `[${++this.#started}/${this.#count}] ${what}`;
    const start = performance.now();
    console.log(`${step} ...`);
    const reminder = setInterval(() => console.log(`${step}: still at work, ${seconds(start)}`), REMINDER_MILLISECONDS);
    try {
      const result = await work();
      console.log(`${step}: ${seconds(start)}`);
      return result;
    } finally {
      clearInterval(reminder);
    }
  }

  end() {
    console.log(`all of it: ${seconds(this.#start)}`);
  }
}
