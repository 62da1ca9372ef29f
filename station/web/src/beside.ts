// Displays of two sessions beside each other: beside.html?left=SESSION&right=SESSION.
// Without a name: the station's own.
import { Connection } from "./connection";
import { element } from "./page";
import { Picture } from "./picture";

const query = new URLSearchParams(location.search);
const open = new Set<string>();

for (const side of ["left", "right"] as const) {
  const session = query.get(side) ?? "";
  element(`${side}_name`).textContent = `${side}: ${session || "this set"}`;
  const picture = new Picture(element<HTMLCanvasElement>(`${side}_picture`));
  new Connection({
    frame: (frame) => picture.show(frame),
    state: ({ watch }) => {
      element(`${side}_words`).textContent =
        `${watch.sim_time.toFixed(1)} s · ${watch.power} · ${watch.mode}${watch.running ? "" : " · time stands"}`;
      document.body.dataset.state = "shown";
    },
    connected: (is) => {
      if (is) open.add(side); else open.delete(side);
      element("status").textContent = open.size === 2 ? "connected" : "no connection to both; trying again";
    },
  }, "display", session);
}
