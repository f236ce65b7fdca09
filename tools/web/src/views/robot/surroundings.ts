// SPDX-License-Identifier: Apache-2.0
// Where the arm works: work frames with the points in them, belts and tables with the direction in which they move, what the
// tool tracks on one of them, and pallets with the places in use.

import * as THREE from "three";
import type { Belt, Pallet, Robot, WorkFrame } from "../../api/types";
import { colour } from "../../shell/theme";
import type { Arm } from "./arm";
import type { Carried } from "./state";

const AXIS = 0.06;  // length of the axes of a frame, as a part of the size of the arm
const WIDTH = 0.12;  // of a belt
const LONG = 0.9;  // of one whose length is not known
const RADIUS = 0.3;  // of a table
const ARROWS = 6;  // on a belt or a table
const TEXT_PX = 44;
const FILL = 0.85;  // size of a place of a pallet, as a part of the distance between two
const SLIP = 1;  // mm or deg by which a belt goes on before what does not move with it counts as not tracked

function place(object: THREE.Object3D, position: number[], orientation: number[]): void {
  object.position.set(position[0], position[1], position[2]).divideScalar(1000);
  const [roll, pitch, yaw] = orientation.map((degrees) => degrees * Math.PI / 180);
  object.rotation.set(roll, pitch, yaw, "ZYX");
}

// A text that always faces the user. Its colour is that of the material.
function label(text: string, height: number): THREE.Sprite {
  const canvas = document.createElement("canvas");
  const font = `600 ${TEXT_PX}px sans-serif`;
  const measured = canvas.getContext("2d")!;
  measured.font = font;
  canvas.width = Math.ceil(measured.measureText(text).width) + 8;
  canvas.height = Math.ceil(TEXT_PX * 1.3);
  const context = canvas.getContext("2d")!;
  context.font = font;
  context.fillStyle = "#fff";
  context.textBaseline = "middle";
  context.fillText(text, 4, canvas.height / 2);
  const sprite = new THREE.Sprite(new THREE.SpriteMaterial({ map: new THREE.CanvasTexture(canvas), depthTest: false }));
  sprite.scale.set(height * canvas.width / canvas.height, height, 1);
  sprite.center.set(0, 0);
  return sprite;
}

// An arrow along x, flat in x and y, with its middle at x = 0.
function arrow(size: number): THREE.BufferGeometry {
  const shape = new THREE.Shape([[0.5, 0], [-0.5, 0.6], [-0.2, 0], [-0.5, -0.6]].map(([x, y]) => new THREE.Vector2(x * size, y * size)));
  return new THREE.ShapeGeometry(shape);
}

// A belt or a table at its frame.
class Carrier {
  readonly group = new THREE.Group();
  private readonly arrows: THREE.Mesh[] = [];
  private readonly length: number;

  constructor(readonly belt: Belt, size: number, ground: THREE.Material, mark: THREE.Material) {
    this.length = belt.turns ? 360 : belt.length / 1000 || LONG * size;
    const body = belt.turns ? new THREE.CircleGeometry(RADIUS * size, 64) : new THREE.PlaneGeometry(this.length, WIDTH * size);
    const surface = new THREE.Mesh(body, ground);
    if (!belt.turns) surface.position.x = this.length / 2;
    this.group.add(surface);
    const shape = arrow(WIDTH * size * 0.45);
    for (let i = 0; i < ARROWS; i++) this.arrows.push(new THREE.Mesh(shape, mark));
    this.group.add(...this.arrows);
    this.move(0, size);
  }

  // `at`: mm, of a table deg.
  move(at: number, size: number): void {
    const step = this.length / ARROWS;
    const shift = ((this.belt.turns ? at : at / 1000) % step + step) % step;
    this.arrows.forEach((one, i) => {
      const now = i * step + shift;
      if (this.belt.turns) {
        const angle = now * Math.PI / 180;
        one.position.set(Math.cos(angle), Math.sin(angle), 0).multiplyScalar(RADIUS * size * 0.8);
        one.rotation.z = angle + Math.PI / 2;
      } else {
        const half = WIDTH * size * 0.23;
        one.position.x = now;
        one.visible = now > half && now < this.length - half;
      }
      one.position.z = size * 1e-3;  // above its surface
    });
  }
}

// The places of a pallet: those in use are solid, the others outlined.
class Places {
  readonly group = new THREE.Group();
  private readonly solids: THREE.Mesh[] = [];

  constructor(pallet: Pallet, size: number, solid: THREE.Material, line: THREE.LineBasicMaterial) {
    const flat = pallet.size.slice(0, 2).filter((pitch) => pitch > 0);
    const usual = flat.length ? Math.min(...flat) / 1000 : size * AXIS;
    const [x, y] = pallet.size.map((pitch) => (pitch / 1000 || usual) * FILL);
    const z = (pallet.size[2] / 1000 || usual * 0.3) * FILL;
    const shape = new THREE.BoxGeometry(x, y, z);
    const edges = new THREE.EdgesGeometry(shape);
    for (const at of pallet.places) {
      const one = new THREE.Group();
      place(one, at, pallet.orientation);
      const mesh = new THREE.Mesh(shape, solid);
      mesh.visible = false;
      this.solids.push(mesh);
      one.add(mesh, new THREE.LineSegments(edges, line));
      this.group.add(one);
    }
  }

  use(count: number): void {
    this.solids.forEach((mesh, i) => { mesh.visible = i < count; });
  }
}

export class Surroundings {
  private readonly group = new THREE.Group();
  private readonly part = new THREE.Group();  // what is tracked
  private readonly ground = new THREE.MeshBasicMaterial({ transparent: true, opacity: 0.35, side: THREE.DoubleSide, depthWrite: false });
  private readonly mark = new THREE.MeshBasicMaterial({ side: THREE.DoubleSide });
  private readonly dot = new THREE.MeshBasicMaterial();
  private readonly texts: THREE.Sprite[] = [];
  private readonly carriers: Carrier[] = [];
  private readonly pallets: Places[] = [];
  private readonly good = new THREE.MeshStandardMaterial({ transparent: true, opacity: 0.8 });
  private readonly line = new THREE.LineBasicMaterial();
  private readonly declared: THREE.Object3D[] = [];  // frames of parts, where the files declare them
  private readonly size: number;
  private last: Carried | null = null;
  private still: number[] = [];  // where the belts were when the product moved last

  constructor(arm: Arm, robot: Robot) {
    this.size = arm.size;
    const frames = robot.work_frames ?? [];
    const parts = new Set((robot.belts ?? []).map(({ part }) => part));
    for (const frame of frames) {
      const drawn = this.frame(frame);
      this.group.add(drawn);
      if (parts.has(frame.name)) this.declared.push(drawn);
    }
    for (const belt of robot.belts ?? []) {
      const along = frames.find(({ name }) => name === belt.along);
      if (!along) continue;
      const carrier = new Carrier(belt, this.size, this.ground, this.mark);
      place(carrier.group, along.position, along.orientation);
      const text = this.text(`${belt.turns ? "table" : "belt"} ${belt.number}`);
      text.position.set(belt.turns ? 0 : this.size * 0.25, -this.size * (belt.turns ? RADIUS : WIDTH) * 1.1, 0);
      carrier.group.add(text);
      this.carriers.push(carrier);
      this.group.add(carrier.group);
    }
    for (const pallet of robot.pallets ?? []) {
      const places = new Places(pallet, this.size, this.good, this.line);
      this.pallets.push(places);
      this.group.add(places.group);
    }
    const edge = this.size * AXIS;
    const box = new THREE.Mesh(new THREE.BoxGeometry(edge, edge, edge * 0.4), this.dot);
    const text = this.text("tracked");
    text.position.z = edge * 2;
    this.part.add(box, new THREE.AxesHelper(edge * 1.5), text);
    this.part.visible = false;
    this.group.add(this.part);
    arm.robot.add(this.group);
    this.recolour();
  }

  show(shown: boolean): void {
    this.group.visible = shown;
  }

  // `used`: how many places of each pallet.
  use(used: number[]): void {
    this.pallets.forEach((places, i) => places.use(used[i] ?? 0));
  }

  // Returns whether the tool tracks a part. It does if the product's coordinates move, or the belts stand.
  carry(now: Carried): boolean {
    for (const carrier of this.carriers) carrier.move(now.belts[carrier.belt.number - 1] ?? 0, this.size);
    const moved = this.last !== null && JSON.stringify(now.product) !== JSON.stringify(this.last.product);
    if (moved) {
      this.still = now.belts;
      this.part.visible = true;
      place(this.part, now.product.slice(0, 3), now.product.slice(3));
    } else if (now.belts.some((at, i) => Math.abs(at - (this.still[i] ?? at)) > SLIP)) {
      this.part.visible = false;
    }
    this.last = now;
    for (const frame of this.declared) frame.visible = !this.part.visible;
    return this.part.visible;
  }

  recolour(): void {
    this.ground.color.set(colour("quiet"));
    this.mark.color.set(colour("accent"));
    this.dot.color.set(colour("c2"));
    this.good.color.set(colour("c3"));
    this.line.color.set(colour("quiet"));
    for (const { material } of this.texts) material.color.set(colour("text"));
  }

  private text(words: string): THREE.Sprite {
    const sprite = label(words, this.size * 0.035);
    this.texts.push(sprite);
    return sprite;
  }

  private frame(frame: WorkFrame): THREE.Object3D {
    const group = new THREE.Group();
    const axes = new THREE.Group();
    place(axes, frame.position, frame.orientation);
    axes.add(new THREE.AxesHelper(this.size * AXIS), this.text(frame.computed ? `${frame.name} (computed)` : frame.name));
    group.add(axes);
    const ball = new THREE.SphereGeometry(this.size * 0.006, 12, 8);
    for (const { position } of frame.points) {
      const dot = new THREE.Mesh(ball, this.dot);
      dot.position.set(position[0], position[1], position[2]).divideScalar(1000);
      group.add(dot);
    }
    return group;
  }
}
