// The workers: each has an engine of its own, made from a blob, so that the page works from a file.

// Returns { ask, forget, busy, stop }: ask(question) waits for the answer of the next free worker; forget() ends what waits,
// stop() also what is computed. Their answers are null.
function makePool(count, source, bytes) {
  const url = URL.createObjectURL(new Blob([source], { type: "text/javascript" }));
  let free = [], waiting = [], all = [];
  const next = () => {
    while (free.length && waiting.length) {
      const worker = free.pop(), job = waiting.shift();
      worker.job = job;
      worker.postMessage(job.question);
    }
  };
  function start() {
    all = [...Array(count)].map(() => {
      const worker = new Worker(url);
      worker.onmessage = ({ data }) => {
        worker.job?.done(data);
        worker.job = null;
        free.push(worker);
        next();
      };
      worker.postMessage(bytes);
      return worker;
    });
    free = [];
    waiting = [];
  }
  start();
  return {
    ask: (question) => new Promise((done) => { waiting.push({ question, done }); next(); }),
    forget() { for (const job of waiting.splice(0)) job.done(null); },
    busy: () => waiting.length + all.filter((worker) => worker.job).length,
    stop() {
      const jobs = [...waiting, ...all.map((worker) => worker.job).filter(Boolean)];
      for (const worker of all) worker.terminate();
      start();
      for (const job of jobs) job.done(null);
    },
  };
}
