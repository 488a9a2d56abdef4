// The players of Figure 2's passages.

if (document.getElementById("played-passages"))
  readPassages("played").then((passages) => {
    for (const box of document.querySelectorAll("#bristle, #passages")) startPlayer(box, passages);
  });
