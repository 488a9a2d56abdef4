// A worker: the first message has the engine's bytes, each further one a question.
let bytes, engine;
onmessage = async ({ data }) => {
  const begins = !bytes;
  bytes ??= data;
  try {
    engine ??= await makeEngine(bytes);
    postMessage(begins ? {} : engine(data));
  } catch (error) {  // a browser without what the engine needs, or no memory
    engine = undefined;
    postMessage({ error: `The engine ended: ${error.message}` });
  }
};
