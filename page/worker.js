// A worker: the first message has the engine's bytes, each further one a question.
let engine;
onmessage = async ({ data }) => {
  if (engine) return postMessage(engine(data));
  engine = await makeEngine(data);
  postMessage({});
};
