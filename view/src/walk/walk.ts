// Walking: the camera is at the eyes of someone who stands on the ground and goes where nothing is in the way.

import * as THREE from 'three';
import type { PageRenderer } from '../renderer.ts';
import type { PageState } from '../state.ts';
import type { Town } from '../town/town.ts';
import { strings } from '../ui/strings.ts';
import { Doors } from './doors.ts';
import { Lamp } from './lamp.ts';
import { CROWN, Obstacles, type Spot } from './obstacles.ts';
import { FARTHEST, SEARCHED, startIndoors, startNear } from './start.ts';
import { nearestCorner, trianglesIn } from './surfaces.ts';

/** Height of the eyes of who stands, above the ground, metres. */
export const EYES = 1.5;

/** Metres a second; with Shift. */
const SPEED = 1.8, FAST = 6;

/** Radians a second. */
const TURN = 1.4, TILT = 0.9;

/** How far eyes look up and down, radians. */
const STEEPEST = 1.2;

/** Vertical angle of view, degrees: a street is wider than a house on a table. */
const FOV = 60;

/** How far around a place its surfaces are gathered, and how far one may walk before it is done again, metres. */
const REACH = 12, MARGIN = 8;

/** Surfaces so far above the ground do not matter to a walker, metres. */
const OVERHEAD = 4;

/** How long the first step lasts, and at most one on a slow machine, seconds. */
const FIRST = 1 / 60, LONGEST = 1;

/** Farther down and up than anything. */
const BEYOND = 1e5;

/** Metres a second at which eyes rise and sink at steps. */
const RISE = 3;

/** How long a press of a button without a pointer lasts, seconds. */
const NUDGE = 0.45;

/** A camera no higher than this above the ground is one from which a walk begins, metres. */
const LOW = 4;

/** Radians a pixel by which a drag turns the eyes. */
const DRAG = 0.004;

export const WAYS = ['ahead', 'back', 'left', 'right', 'turn-left', 'turn-right', 'up', 'down'] as const;
export type Way = (typeof WAYS)[number];

const KEYS: Record<string, Way> = {
  KeyW: 'ahead', ArrowUp: 'ahead', KeyS: 'back', ArrowDown: 'back', KeyA: 'left', KeyD: 'right',
  ArrowLeft: 'turn-left', ArrowRight: 'turn-right', PageUp: 'up', PageDown: 'down',
};

export class Walk {
  on = false;
  readonly doors: Doors;
  readonly lamp: Lamp;
  #state: PageState;
  #renderer: PageRenderer;
  #town: Town;
  #held = new Set<Way>();
  #fast = false;
  #obstacles: Obstacles | null = null;
  /** Where surfaces were gathered. */
  #middle: Spot = [0, 0];
  #spot: Spot = [0, 0];
  #ground = 0;
  #eyes = 0;
  /** The eyes of who stands or stoops, above the ground. */
  #height = EYES;
  /** Clockwise from north, radians. */
  #heading = 0;
  #tilt = 0;
  /** When the last step was made; null if there was none. */
  #last: number | null = null;
  #moving = false;
  /** True while the camera is moved from here. */
  #own = false;
  #ended = new AbortController();

  constructor(state: PageState, renderer: PageRenderer, town: Town) {
    this.#state = state;
    this.#renderer = renderer;
    this.#town = town;
    const { viewport } = renderer;
    this.doors = new Doors(state, viewport, town);
    this.doors.onMoved = () => this.forget();
    this.lamp = new Lamp(state, viewport);
    town.onTiles.push(() => this.forget());
    // Whatever else moves the camera ends the walk.
    viewport.controls.addEventListener('change', () => { if (this.on && !this.#own) this.leave(); });
  }

  /** Where one stands: x, height of the ground, z; metres. */
  get place(): [number, number, number] { return [this.#spot[0], this.#ground, this.#spot[1]]; }

  #gather([x, z]: Spot, reach: number, low: number, high: number): Obstacles {
    const box = new THREE.Box3(new THREE.Vector3(x - reach, low, z - reach), new THREE.Vector3(x + reach, high, z + reach));
    return new Obstacles(trianglesIn(box, this.#renderer.meshes()), [x, z], reach, this.#renderer.viewport.environment.level);
  }

  /** What matters to where a walk begins. */
  #around(spot: Spot): Obstacles { return this.#gather(spot, SEARCHED + FARTHEST, -BEYOND, BEYOND); }

  /** Begins near what is looked at, or before the selected house; false if there is no room. */
  start(): boolean {
    const { viewport: { camera, controls, environment, canvas }, turntable } = this.#renderer, town = this.#town;
    if (this.on) return true;
    turntable.set(false);
    if (town.selected) town.standBefore();
    const low = camera.position.y < environment.level + LOW, place = low ? camera.position : controls.target;
    const ahead = camera.getWorldDirection(new THREE.Vector3()), facing = Math.atan2(ahead.x, -ahead.z);
    const { x, y, z } = camera.position, room = startIndoors(this.#around([x, z]), [x, z], y, facing);
    let spot: Spot = [place.x, place.z], around = this.#around(spot);
    // Among houses rather than on open land.
    const house = !low && around.none && nearestCorner(place, this.#renderer.meshes());
    if (house) around = this.#around(spot = [house.x, house.z]);
    const start = room ?? startNear(around, spot, facing);
    if (!start) {
      this.#state.announce(strings.noRoomToWalk);
      return false;
    }
    this.on = true;
    // Who stands on the street already goes on to look at the same front.
    [this.#spot, this.#ground, this.#heading] = [start.spot, start.ground, low || room ? facing : start.heading];
    this.#height = EYES;
    this.#eyes = start.ground + EYES;
    this.#tilt = 0;
    this.#obstacles = null;
    controls.enabled = false;
    this.#ended = new AbortController();
    this.#listen(canvas, this.#ended.signal);
    canvas.setAttribute('aria-label', strings.walkCanvas);
    this.#look(FOV);
    this.#state.announce(strings.walking);
    this.#state.emit('walk');
    return true;
  }

  /** Ends the walk; the camera stays where it is. */
  leave() {
    if (!this.on) return;
    const { viewport } = this.#renderer, { canvas, controls } = viewport;
    this.on = false;
    this.lamp.set(false);
    this.#ended.abort();
    this.#held.clear();
    this.#obstacles = null;
    controls.enabled = true;
    canvas.setAttribute('aria-label', strings.canvas);
    viewport.setFieldOfView(null);
    viewport.draw();
    this.#state.announce(strings.walked);
    this.#state.emit('walk');
  }

  /** Forgets the surfaces nearby, since others are shown. */
  forget() { this.#obstacles = null; }

  /** Goes or turns as long as it is held. */
  hold(way: Way, held: boolean) {
    if (held) this.#held.add(way); else this.#held.delete(way);
    if (held) this.#begin();
  }

  /** Goes or turns for a moment. */
  nudge(way: Way) {
    if (!this.on) return;
    const before = this.#held;
    this.#held = new Set([way]);
    this.#step(NUDGE);
    this.#held = before;
    this.#begin(); // Eyes settle.
  }

  /** Handles a key on the canvas; returns false if it has no meaning here. */
  handleKey(event: KeyboardEvent): boolean {
    if (!this.on || event.ctrlKey || event.metaKey || event.altKey) return false;
    this.#fast = event.shiftKey;
    const way = KEYS[event.code];
    if (way) this.hold(way, true);
    else if (event.key === 'Escape') this.leave();
    else if (event.code === 'KeyL') this.lamp.set(!this.lamp.on);
    else if (event.code === 'KeyE') this.useDoor();
    else if (event.key === 'Enter') return this.doors.use(this.#ahead());
    else return false;
    return true;
  }

  /** Slides the door ahead, or tells that there is none. */
  useDoor() { if (this.on && !this.doors.use(this.#ahead())) this.#state.announce(strings.noDoor); }

  #ahead(): THREE.Raycaster {
    const { canvas } = this.#renderer.viewport;
    return this.#renderer.rayAt(canvas.clientWidth / 2, canvas.clientHeight / 2);
  }

  #listen(canvas: HTMLCanvasElement, signal: AbortSignal) {
    let from: { x: number; y: number } | null = null;
    window.addEventListener('keyup', event => {
      this.#fast = event.shiftKey;
      const way = KEYS[event.code];
      if (way) this.hold(way, false);
    }, { signal });
    canvas.addEventListener('blur', () => this.#held.clear(), { signal });
    canvas.addEventListener('pointerdown', ({ clientX: x, clientY: y, isPrimary, pointerId }) => {
      if (!isPrimary) return;
      from = { x, y };
      canvas.setPointerCapture(pointerId);
    }, { signal });
    canvas.addEventListener('pointermove', ({ clientX: x, clientY: y, isPrimary }) => {
      if (!from || !isPrimary) return;
      // The picture follows the finger.
      this.#turn((from.x - x) * DRAG, (y - from.y) * DRAG);
      from = { x, y };
      this.#look();
    }, { signal });
    for (const end of ['pointerup', 'pointercancel'] as const) canvas.addEventListener(end, () => { from = null; }, { signal });
  }

  #turn(right: number, up: number) {
    this.#heading += right;
    this.#tilt = THREE.MathUtils.clamp(this.#tilt + up, -STEEPEST, STEEPEST);
  }

  #begin() {
    if (this.#moving || !this.on) return;
    this.#moving = true;
    this.#last = null;
    requestAnimationFrame(this.#move);
  }

  #move = (now: number) => {
    const seconds = this.#last === null ? FIRST : THREE.MathUtils.clamp((now - this.#last) / 1000, 0, LONGEST);
    this.#last = now;
    this.#moving = this.on && this.#step(seconds);
    if (this.#moving) requestAnimationFrame(this.#move);
  };

  /** Goes and turns as what is held says; returns true if there is more to come. */
  #step(seconds: number): boolean {
    const held = (way: Way) => Number(this.#held.has(way));
    this.#turn((held('turn-right') - held('turn-left')) * TURN * seconds, (held('up') - held('down')) * TILT * seconds);
    const far = (this.#fast ? FAST : SPEED) * seconds, ahead = held('ahead') - held('back'), right = held('right') - held('left');
    if (ahead || right) {
      const turn = this.#heading + Math.atan2(right, ahead);
      this.#walk([Math.sin(turn) * far, -Math.cos(turn) * far]);
    }
    const rise = this.#ground + this.#height - this.#eyes;
    this.#eyes += THREE.MathUtils.clamp(rise, -RISE * seconds, RISE * seconds);
    this.#look();
    return this.#held.size > 0 || Math.abs(rise) > 1e-3;
  }

  #walk(way: Spot) {
    const [x, z] = this.#spot;
    if (!this.#obstacles || Math.hypot(x - this.#middle[0], z - this.#middle[1]) > MARGIN) {
      this.#obstacles = this.#gather(this.#middle = [x, z], REACH, -BEYOND, this.#ground + OVERHEAD);
    }
    const { spot, ground } = this.#obstacles.walk(this.#spot, this.#ground, way);
    this.#spot = spot;
    this.#ground = ground;
    this.#height = this.#obstacles.headroom(spot, ground) - CROWN;
  }

  /** Puts the camera to the eyes. */
  #look(fov?: number) {
    const { viewport } = this.#renderer, { camera, controls } = viewport, level = Math.cos(this.#tilt);
    const ahead = new THREE.Vector3(Math.sin(this.#heading) * level, Math.sin(this.#tilt), -Math.cos(this.#heading) * level);
    this.#own = true;
    if (fov) viewport.setFieldOfView(fov);
    camera.position.set(this.#spot[0], this.#eyes, this.#spot[1]);
    this.lamp.hold(camera);
    controls.target.copy(camera.position).addScaledVector(ahead, 6);
    camera.lookAt(controls.target);
    controls.dispatchEvent({ type: 'change' });
    this.#own = false;
  }
}
