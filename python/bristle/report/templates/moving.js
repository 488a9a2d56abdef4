// The players of Figure 2's passages.

if (document.querySelector('a.data[download="fig2-trajectories.csv.gz"]'))
  readPassages("fig2").then((passages) => {
    for (const box of document.querySelectorAll("#bristle, #passages")) startPlayer(box, passages);
  });
