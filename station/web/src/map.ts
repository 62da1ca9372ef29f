// The instructor's map: hill shade of the server, what flies and stands on it; moved, zoomed and dragged by pointer.
// Projection: plate carree about the middle of the view; shapes are true there.
import { InstructorState, Theatre } from "./messages";
import { Lists, LISTS } from "./values";

const TILE_DEG = 8;
const TILE_PIXELS = 256;
const MAX_LEVEL = 12;
const TILE_MEMORY = 300;
const M_PER_DEG = 111319.49;
export const M_PER_NM = 1852;
const DEG = Math.PI / 180;
const TRAIL_POINTS = 2000;
const PATCHES_SHOWN = 2; // the newest: the radar repeats a map as the aircraft moves
const TOUCH_PX = 22; // distance at which a symbol is under the pointer
const SYMBOL_PX = 8, RING_PX = 13, AIRCRAFT_PX = 14; // radii of what they cover
const ABOVE_BASELINE_PX = 12, BELOW_BASELINE_PX = 3; // of a label

export interface Position { lat: number; lon: number }
export type Kind = "aircraft" | keyof Lists;
export const wordOf = (kind: Kind): string => LISTS.find(({ name }) => name === kind)?.word ?? kind;
// Lists that the map draws in a way of their own. Entries of others are squares.
const DRAWN: readonly (keyof Lists)[] = ["rain", "jammers", "movers", "points"];
export interface Thing extends Position { kind: Kind; id: number; name: string }
type Box = [number, number, number, number]; // left, top, right, bottom [pixels]
interface Label { x: number; y: number; text: string; colour: string; radius: number; first: boolean }

// Where and what the user did on the map.
export interface MapUser {
  moved(thing: Thing, to: Position): void; // dragged
  chosen(thing: Thing | undefined): void;
  placed(at: Position): void; // a click while `placing`
}

// Name of a thing of the world: its own, or a word with its id. That of a sequence point is a number.
function nameOf(kind: Kind, entry: { id: number; name?: string }): string {
  if (kind === "points") return `point ${entry.name}`;
  return entry.name || `${wordOf(kind)} ${entry.id}`;
}

export const wrap = (lon: number): number => ((((lon + 180) % 360) + 360) % 360) - 180;

// Point at a distance and true bearing, on a sphere: symbols need no more.
export function pointFrom(from: Position, bearing_deg: number, distance_m: number): Position {
  const angle = distance_m / (M_PER_DEG / DEG);
  const lat1 = from.lat * DEG, bearing = bearing_deg * DEG;
  const lat2 = Math.asin(Math.sin(lat1) * Math.cos(angle) + Math.cos(lat1) * Math.sin(angle) * Math.cos(bearing));
  const east = Math.atan2(Math.sin(bearing) * Math.sin(angle) * Math.cos(lat1),
    Math.cos(angle) - Math.sin(lat1) * Math.sin(lat2));
  return { lat: lat2 / DEG, lon: wrap(from.lon + east / DEG) };
}

export class TheatreMap {
  placing = false;
  follow = true;
  chosen: { kind: Kind; id: number } | undefined;
  private readonly context: CanvasRenderingContext2D;
  private centre: Position = { lat: 0, lon: 0 };
  private pixelsPerDeg = 200; // of latitude
  private state: InstructorState | undefined;
  private theatre: Theatre | undefined;
  private trail: Position[] = [];
  private epoch = -1;
  private readonly tiles = new Map<string, HTMLImageElement>();
  private readonly patches = new Map<string, HTMLImageElement>();
  private drag: { x: number; y: number; thing: Thing | undefined; at: Position | undefined; far: boolean } | undefined;
  private readonly pointers = new Map<number, { x: number; y: number }>();
  private due = false;
  private labels: Label[] = []; // of a drawing, the most important last
  private taken: Box[] = []; // room that symbols and labels of a drawing take

  constructor(private readonly canvas: HTMLCanvasElement, private readonly user: MapUser) {
    const context = canvas.getContext("2d", { alpha: false });
    if (!context) throw new Error("expected a browser with canvas, found one without");
    this.context = context;
    new ResizeObserver(() => this.resize()).observe(canvas);
    canvas.addEventListener("pointerdown", (event) => this.press(event));
    canvas.addEventListener("pointermove", (event) => this.drags(event));
    canvas.addEventListener("pointerup", (event) => this.release(event));
    canvas.addEventListener("pointercancel", (event) => {
      this.pointers.delete(event.pointerId);
      this.drag = undefined;
    });
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.zoom(Math.exp(-0.0015 * event.deltaY), this.pointOf(event));
    }, { passive: false });
    canvas.addEventListener("keydown", (event) => this.key(event));
  }

  show(theatre: Theatre): void {
    this.theatre = theatre;
    this.redraw();
  }

  update(state: InstructorState): void {
    const first = this.state === undefined;
    this.state = state;
    if (state.clock.epoch !== this.epoch) this.trail = [];
    this.epoch = state.clock.epoch;
    if (state.aircraft) {
      const last = this.trail[this.trail.length - 1];
      if (!last || Math.hypot(last.lat - state.aircraft.lat, last.lon - state.aircraft.lon) > 1e-3)
        this.trail.push({ lat: state.aircraft.lat, lon: state.aircraft.lon });
      if (this.trail.length > TRAIL_POINTS) this.trail.shift();
      if (first && this.follow)
        this.pixelsPerDeg = this.height() / (2.6 * Math.max(10, state.scan?.range_nm ?? 40) / 60);
      if (this.follow && !this.drag) this.centre = { lat: state.aircraft.lat, lon: state.aircraft.lon };
    }
    this.redraw();
  }

  // Middle of the view, where a new thing is put without a pointer.
  middle(): Position { return { ...this.centre }; }

  goTo(position: Position, width_nm = 20): void {
    this.follow = false;
    this.centre = { ...position };
    this.pixelsPerDeg = Math.max(this.pixelsPerDeg, this.height() / (width_nm / 60));
    this.redraw();
  }

  zoom(factor: number, about?: { x: number; y: number }): void {
    const before = about && !this.follow ? this.positionAt(about.x, about.y) : undefined;
    this.pixelsPerDeg = Math.min(600000, Math.max(4, this.pixelsPerDeg * factor));
    if (before && about) {
      const after = this.positionAt(about.x, about.y);
      this.centre = {
        lat: this.centre.lat + before.lat - after.lat, lon: wrap(this.centre.lon + before.lon - after.lon) };
    }
    this.redraw();
  }

  // All things that can be moved.
  things(): Thing[] {
    const { state } = this;
    if (!state) return [];
    const list: Thing[] = state.aircraft
      ? [{ kind: "aircraft", id: 0, name: "aircraft", lat: state.aircraft.lat, lon: state.aircraft.lon }] : [];
    for (const { name: kind } of LISTS)
      for (const entry of state.world?.[kind] ?? [])
        list.push({ kind, id: entry.id, name: nameOf(kind, entry), lat: entry.latitude_deg, lon: entry.longitude_deg });
    return list;
  }

  private width(): number { return this.canvas.clientWidth; }
  private height(): number { return this.canvas.clientHeight; }
  private eastScale(): number { return Math.max(0.02, Math.cos(this.centre.lat * DEG)); }

  private xy(position: Position): [number, number] {
    return [this.width() / 2 + wrap(position.lon - this.centre.lon) * this.pixelsPerDeg * this.eastScale(),
      this.height() / 2 - (position.lat - this.centre.lat) * this.pixelsPerDeg];
  }
  private positionAt(x: number, y: number): Position {
    return { lat: Math.min(90, Math.max(-90, this.centre.lat + (this.height() / 2 - y) / this.pixelsPerDeg)),
      lon: wrap(this.centre.lon + (x - this.width() / 2) / (this.pixelsPerDeg * this.eastScale())) };
  }
  private pointOf(event: MouseEvent): { x: number; y: number } {
    const box = this.canvas.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  }
  private thingAt(x: number, y: number): Thing | undefined {
    let best: Thing | undefined, least = TOUCH_PX;
    for (const thing of this.things()) {
      const [left, top] = this.xy(thing);
      const distance = Math.hypot(left - x, top - y);
      if (distance < least) { best = thing; least = distance; }
    }
    return best;
  }

  private press(event: PointerEvent): void {
    if (event.button !== 0) return;
    const { x, y } = this.pointOf(event);
    this.pointers.set(event.pointerId, { x, y });
    this.canvas.setPointerCapture(event.pointerId);
    if (this.pointers.size > 1) { this.drag = undefined; return; }
    this.drag = { x, y, thing: this.placing ? undefined : this.thingAt(x, y), at: undefined, far: false };
  }

  private drags(event: PointerEvent): void {
    const { x, y } = this.pointOf(event);
    const before = this.pointers.get(event.pointerId);
    if (before && this.pointers.size === 2) { // two fingers zoom
      const other = [...this.pointers].find(([id]) => id !== event.pointerId)?.[1];
      if (other)
        this.zoom(Math.hypot(x - other.x, y - other.y) /
          Math.max(1, Math.hypot(before.x - other.x, before.y - other.y)), other);
    }
    if (before) this.pointers.set(event.pointerId, { x, y });
    const { drag } = this;
    if (!drag) {
      this.canvas.style.cursor = this.placing ? "copy" : this.thingAt(x, y) ? "grab" : "move";
      return;
    }
    if (!drag.far && Math.hypot(x - drag.x, y - drag.y) < 4) return;
    drag.far = true;
    if (drag.thing) {
      drag.at = this.positionAt(x, y);
    } else if (before) {
      this.follow = false;
      this.centre = { lat: Math.min(89, Math.max(-89, this.centre.lat + (y - before.y) / this.pixelsPerDeg)),
        lon: wrap(this.centre.lon - (x - before.x) / (this.pixelsPerDeg * this.eastScale())) };
    }
    this.redraw();
  }

  private release(event: PointerEvent): void {
    this.pointers.delete(event.pointerId);
    const { drag } = this;
    this.drag = undefined;
    if (!drag) return;
    if (drag.thing && drag.at) this.user.moved(drag.thing, drag.at);
    else if (!drag.far && this.placing) this.user.placed(this.positionAt(drag.x, drag.y));
    else if (!drag.far) this.user.chosen(drag.thing);
    this.redraw();
  }

  private key(event: KeyboardEvent): void {
    const step = 60 / this.pixelsPerDeg;
    const shifts: Record<string, [number, number]> =
      { ArrowUp: [step, 0], ArrowDown: [-step, 0], ArrowLeft: [0, -step], ArrowRight: [0, step] };
    if (event.key === "+" || event.key === "-") this.zoom(event.key === "+" ? 1.5 : 1 / 1.5);
    else if (event.key in shifts) {
      this.follow = false;
      this.centre = { lat: this.centre.lat + shifts[event.key][0],
        lon: wrap(this.centre.lon + shifts[event.key][1] / this.eastScale()) };
      this.redraw();
    } else return;
    event.preventDefault();
  }

  private resize(): void {
    this.canvas.width = Math.round(this.width() * devicePixelRatio);
    this.canvas.height = Math.round(this.height() * devicePixelRatio);
    this.redraw();
  }

  private redraw(): void {
    if (this.due) return;
    this.due = true;
    requestAnimationFrame(() => {
      this.due = false;
      this.draw();
    });
  }

  private draw(): void {
    const { context } = this;
    context.setTransform(devicePixelRatio, 0, 0, devicePixelRatio, 0, 0);
    context.fillStyle = "#18223a";
    context.fillRect(0, 0, this.width(), this.height());
    this.labels = [];
    this.taken = [];
    this.drawTiles();
    this.drawPatches();
    this.drawTheatre();
    this.drawWorld();
    this.drawAircraft();
    this.drawScale();
    this.drawLabels();
  }

  private drawTiles(): void {
    if (!this.state) return; // the map does not know yet where it is
    const wanted = Math.log2((TILE_DEG * this.pixelsPerDeg) / TILE_PIXELS);
    const level = Math.min(MAX_LEVEL, Math.max(0, Math.round(wanted)));
    const edge = TILE_DEG / 2 ** level, columns = 360 / edge;
    const halfLat = this.height() / 2 / this.pixelsPerDeg;
    const halfLon = this.width() / 2 / (this.pixelsPerDeg * this.eastScale());
    if (halfLon > 180) return;
    const first = Math.floor((this.centre.lon - halfLon + 180) / edge);
    const last = Math.floor((this.centre.lon + halfLon + 180) / edge);
    const bottom = Math.max(0, Math.floor((this.centre.lat - halfLat + 90) / edge));
    const top = Math.min(180 / edge - 1, Math.floor((this.centre.lat + halfLat + 90) / edge));
    for (let row = bottom; row <= top; ++row)
      for (let column = first; column <= last; ++column) {
        const left = this.width() / 2 + (column * edge - 180 - this.centre.lon) * this.pixelsPerDeg * this.eastScale();
        const up = this.height() / 2 - ((row + 1) * edge - 90 - this.centre.lat) * this.pixelsPerDeg;
        this.tile(level, row, ((column % columns) + columns) % columns);
        this.drawTile(level, row, ((column % columns) + columns) % columns, left, up, edge * this.pixelsPerDeg);
      }
  }

  // Draws a tile, or the part of a coarser one while it is awaited.
  private drawTile(level: number, row: number, column: number, left: number, up: number, edge: number): void {
    for (let coarser = 0; coarser <= Math.min(level, 4); ++coarser) {
      const parts = 2 ** coarser;
      const tile = this.tiles.get(
        `map/${level - coarser}/${Math.floor(row / parts)}/${Math.floor(column / parts)}.png`);
      if (!tile?.complete || tile.naturalWidth === 0) continue;
      const part = TILE_PIXELS / parts;
      this.context.drawImage(tile, (column % parts) * part, (parts - 1 - (row % parts)) * part, part, part,
        left, up, edge * this.eastScale() + 0.5, edge + 0.5);
      return;
    }
  }

  private tile(level: number, row: number, column: number): HTMLImageElement {
    const path = `map/${level}/${row}/${column}.png`;
    let image = this.tiles.get(path);
    if (image) return image;
    image = new Image();
    image.onload = () => this.redraw();
    image.onerror = () => this.tiles.delete(path); // asked again at the next drawing
    image.src = path;
    this.tiles.set(path, image);
    if (this.tiles.size > TILE_MEMORY) this.tiles.delete(this.tiles.keys().next().value as string);
    return image;
  }

  // Radar pictures of patch maps, laid on the ground: three corners give the affine transform.
  private drawPatches(): void {
    const { context, state } = this;
    if (!state) return;
    for (const patch of state.patches.slice(0, PATCHES_SHOWN).reverse()) {
      const key = `patch/${state.session}/${patch.id}.png`;
      let image = this.patches.get(key);
      if (!image) {
        image = new Image();
        image.onload = () => this.redraw();
        image.src = key;
        this.patches.set(key, image);
        if (this.patches.size > 16) this.patches.delete(this.patches.keys().next().value as string);
      }
      const [farLeft, farRight, , nearLeft] = patch.corners.map(([lat, lon]) => this.xy({ lat, lon }));
      if (image.complete && image.naturalWidth > 0) {
        context.save();
        context.transform((farRight[0] - farLeft[0]) / patch.size, (farRight[1] - farLeft[1]) / patch.size,
          (nearLeft[0] - farLeft[0]) / patch.size, (nearLeft[1] - farLeft[1]) / patch.size, farLeft[0], farLeft[1]);
        context.drawImage(image, 0, 0);
        context.restore();
      }
      this.outline(patch.corners, "#ffe27a");
    }
    if (state.forming) this.outline(state.forming.corners, "#ffe27a", [6, 5]);
  }

  private outline(corners: [number, number][], colour: string, dashes: number[] = []): void {
    const { context } = this;
    context.beginPath();
    corners.forEach(([lat, lon], at) =>
      (at === 0 ? context.moveTo(...this.xy({ lat, lon })) : context.lineTo(...this.xy({ lat, lon }))));
    context.closePath();
    context.setLineDash(dashes);
    context.lineWidth = 1.5;
    context.strokeStyle = colour;
    context.stroke();
    context.setLineDash([]);
  }

  private line(points: Position[], colour: string, width: number, dashes: number[] = []): void {
    const { context } = this;
    context.beginPath();
    points.forEach((point, at) => (at === 0 ? context.moveTo(...this.xy(point)) : context.lineTo(...this.xy(point))));
    context.setLineDash(dashes);
    context.lineWidth = width;
    context.strokeStyle = colour;
    context.stroke();
    context.setLineDash([]);
  }

  // A label of what is at a position, drawn when all symbols are. `radius`: what its symbol covers [pixels].
  // `first`: it has room before all others.
  private label(position: Position, text: string, colour: string, radius: number, first = false): void {
    const [x, y] = this.xy(position);
    if (x >= 0 && y >= 0 && x <= this.width() && y <= this.height())
      this.labels.push({ x, y, text, colour, radius, first });
  }

  // Room that a symbol takes: no label lies on it.
  private cover(position: Position, radius: number): void {
    const [x, y] = this.xy(position);
    this.taken.push([x - radius, y - radius, x + radius, y + radius]);
  }

  // Each label lies at the first side of its symbol that is free of symbols and labels.
  // One without such a side comes with a nearer view.
  private drawLabels(): void {
    const { context, taken } = this;
    context.font = "12px system-ui, sans-serif";
    context.textAlign = "center";
    const ordered = this.labels.reverse().sort((one, other) => Number(other.first) - Number(one.first));
    for (const { x, y, text, colour, radius } of ordered) {
      const half = context.measureText(text).width / 2 + 2;
      const beside = radius + half + 1, diagonal = 0.7 * radius + half;
      const below = radius + ABOVE_BASELINE_PX + 1, above = -radius - BELOW_BASELINE_PX - 1;
      const sides: [number, number][] = [[0, below], [beside, 4], [-beside, 4], [0, above],
        [diagonal, below], [-diagonal, below], [diagonal, above], [-diagonal, above]];
      if (radius === 0) sides.unshift([0, 4]);
      for (const [right, down] of sides) {
        const box: Box = [x + right - half, y + down - ABOVE_BASELINE_PX,
          x + right + half, y + down + BELOW_BASELINE_PX];
        const outside = box[0] < 0 || box[1] < 0 || box[2] > this.width() || box[3] > this.height();
        if (outside || taken.some((other) => other[0] < box[2] && box[0] < other[2] &&
          other[1] < box[3] && box[1] < other[3])) continue;
        taken.push(box);
        context.lineWidth = 3;
        context.strokeStyle = "#000c";
        context.strokeText(text, x + right, y + down);
        context.fillStyle = colour;
        context.fillText(text, x + right, y + down);
        break;
      }
    }
  }

  private dot(position: Position, colour: string, shape: "circle" | "square" | "triangle" | "diamond"): void {
    const { context } = this;
    const [x, y] = this.xy(position);
    const size = 6;
    context.beginPath();
    if (shape === "circle") context.arc(x, y, size, 0, 2 * Math.PI);
    else if (shape === "square") context.rect(x - size, y - size, 2 * size, 2 * size);
    else if (shape === "triangle") {
      context.moveTo(x, y - size - 1);
      context.lineTo(x + size, y + size);
      context.lineTo(x - size, y + size);
    } else {
      context.moveTo(x, y - size);
      context.lineTo(x + size, y);
      context.lineTo(x, y + size);
      context.lineTo(x - size, y);
    }
    context.closePath();
    context.fillStyle = colour;
    context.fill();
    context.lineWidth = 1.5;
    context.strokeStyle = "#000";
    context.stroke();
    this.cover(position, SYMBOL_PX);
  }

  private drawTheatre(): void {
    const { theatre } = this;
    if (!theatre) return;
    this.line(theatre.route.map(([lat, lon]) => ({ lat, lon })), "#ffffffb0", 1.5, [8, 5]);
    for (const beacon of theatre.beacons) {
      this.dot(beacon, "#c9a6ff", "diamond");
      this.label(beacon, beacon.name || `beacon ${beacon.code}`, "#dcc6ff", SYMBOL_PX);
    }
    for (const scene of theatre.scenes) this.label(scene, scene.name, "#fff", 0);
  }

  // Where a thing is drawn: at the pointer while it is dragged.
  private place(kind: Kind, id: number, position: Position): Position {
    const { drag } = this;
    return drag?.at && drag.thing?.kind === kind && drag.thing.id === id ? drag.at : position;
  }

  // The label of a thing of the world, and a ring about it if it is chosen. That label has room before all others.
  private mark(position: Position, kind: Kind, id: number, text: string, colour: string): void {
    const chosen = this.chosen?.kind === kind && this.chosen.id === id;
    if (text !== "") this.label(position, text, colour, chosen ? RING_PX : SYMBOL_PX, chosen);
    if (!chosen) return;
    const { context } = this;
    context.beginPath();
    context.arc(...this.xy(position), RING_PX - 1, 0, 2 * Math.PI);
    context.lineWidth = 2;
    context.strokeStyle = "#7db7ff";
    context.stroke();
    this.cover(position, RING_PX);
  }

  private drawWorld(): void {
    const { context, state } = this;
    for (const rain of state?.world?.rain ?? []) {
      const at = this.place("rain", rain.id, { lat: rain.latitude_deg, lon: rain.longitude_deg });
      const [x, y] = this.xy(at);
      const radius = (rain.radius_nm * M_PER_NM / M_PER_DEG) * this.pixelsPerDeg;
      const shade = context.createRadialGradient(x, y, 0, x, y, Math.max(1, radius));
      shade.addColorStop(0, "#5aa8ffb0");
      shade.addColorStop(1, "#5aa8ff18");
      context.beginPath();
      context.arc(x, y, radius, 0, 2 * Math.PI);
      context.fillStyle = shade;
      context.fill();
      context.lineWidth = 1;
      context.strokeStyle = "#9ccbff";
      context.stroke();
      this.dot(at, "#5aa8ff", "circle");
      this.mark(at, "rain", rain.id, `rain ${rain.id}: ${Math.round(rain.rate_mmh * 10) / 10} mm/h`, "#cfe6ff");
    }
    for (const jammer of state?.world?.jammers ?? []) {
      const at = this.place("jammers", jammer.id, { lat: jammer.latitude_deg, lon: jammer.longitude_deg });
      this.dot(at, "#ff7a6b", "triangle");
      this.mark(at, "jammers", jammer.id, nameOf("jammers", jammer), "#ffc0b8");
    }
    for (const mover of state?.world?.movers ?? []) {
      const at = this.place("movers", mover.id, { lat: mover.latitude_deg, lon: mover.longitude_deg });
      // The way of five minutes.
      this.line([at, pointFrom(at, mover.heading_deg, mover.speed_kt * M_PER_NM / 12)], "#ffd27a", 2);
      this.dot(at, "#ffd27a", "square");
      this.mark(at, "movers", mover.id, nameOf("movers", mover), "#ffe7b8");
    }
    for (const point of state?.world?.points ?? []) {
      const at = this.place("points", point.id, { lat: point.latitude_deg, lon: point.longitude_deg });
      this.dot(at, "#b9e0ff",
        point.kind.startsWith("target") ? "triangle" : point.kind === "initial" ? "square" : "circle");
      this.mark(at, "points", point.id,
        point.name === state?.sequence_point ? `${point.name} selected` : point.name, "#b9e0ff");
    }
    for (const { name } of LISTS.filter((list) => !DRAWN.includes(list.name)))
      for (const entry of state?.world?.[name] ?? []) {
        const at = this.place(name, entry.id, { lat: entry.latitude_deg, lon: entry.longitude_deg });
        this.dot(at, "#d9c2ff", "square");
        this.mark(at, name, entry.id, nameOf(name, entry), "#d9c2ff");
      }
  }

  private drawAircraft(): void {
    const { context, state } = this;
    if (!state?.aircraft) return;
    const { scan } = state;
    this.line(this.trail, "#9be29b", 2);
    const at = this.place("aircraft", 0, state.aircraft);
    if (scan?.scanning && scan.range_nm > 0) {
      const range_m = scan.range_nm * M_PER_NM, begin = scan.centre_deg - scan.width_deg / 2;
      const arc = Array.from({ length: 33 }, (_, step) => pointFrom(at, begin + (scan.width_deg * step) / 32, range_m));
      context.beginPath();
      [at, ...arc].forEach((point, step) =>
        (step === 0 ? context.moveTo(...this.xy(point)) : context.lineTo(...this.xy(point))));
      context.closePath();
      context.fillStyle = "#9be29b22";
      context.fill();
      context.lineWidth = 1;
      context.strokeStyle = "#9be29b";
      context.stroke();
      if (scan.beam_deg !== null) this.line([at, pointFrom(at, scan.beam_deg, range_m)], "#d8ffd8", 1.5);
    }
    const [x, y] = this.xy(at);
    context.save();
    context.translate(x, y);
    context.rotate(state.aircraft.heading_deg * DEG);
    context.beginPath();
    for (const [right, down] of [[0, -13], [3, -3], [13, 4], [13, 7], [3, 4], [2, 10], [6, 13], [-6, 13], [-2, 10],
      [-3, 4], [-13, 7], [-13, 4], [-3, -3]])
      context.lineTo(right, down);
    context.closePath();
    context.fillStyle = "#e8ffe8";
    context.fill();
    context.lineWidth = 1.5;
    context.strokeStyle = "#123";
    context.stroke();
    context.restore();
    this.cover(at, AIRCRAFT_PX);
    this.mark(at, "aircraft", 0, "", "");
  }

  private drawScale(): void {
    const { context } = this;
    const perNm = this.pixelsPerDeg / 60;
    const length = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000].find((nm) => nm * perNm > 60) ?? 1000;
    const y = this.height() - 14;
    context.fillStyle = "#000a";
    context.fillRect(8, y - 18, length * perNm + 16, 28);
    this.taken.push([8, y - 18, length * perNm + 24, this.height()]);
    context.strokeStyle = "#fff";
    context.lineWidth = 2;
    context.beginPath();
    context.moveTo(16, y - 4);
    context.lineTo(16, y + 2);
    context.lineTo(16 + length * perNm, y + 2);
    context.lineTo(16 + length * perNm, y - 4);
    context.stroke();
    context.font = "12px system-ui, sans-serif";
    context.textAlign = "left";
    context.fillStyle = "#fff";
    context.fillText(`${length} NM`, 20, y - 4);
  }
}
