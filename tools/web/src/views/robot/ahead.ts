// SPDX-License-Identifier: Apache-2.0
// Where the tool will go (ROBOT_PATH), drawn with its speed as colour. What the tool has passed is left out.

import * as THREE from "three";
import { Line2 } from "three/examples/jsm/lines/Line2.js";
import { LineGeometry } from "three/examples/jsm/lines/LineGeometry.js";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { speed_rgb } from "./speeds";
import type { Way } from "./state";

const PARTS = 8;  // between two places, so that colours follow the scale
const WINDOW = 4 * PARTS;  // points by which the tool may go on between two frames
const WIDTH = 4;  // px

interface Point {
  at: THREE.Vector3;  // m
  speed: number;  // mm/s
}

function points_of({ places, speeds }: Way): Point[] {
  return places.flatMap((to, i) => {
    if (i === 0) return [{ at: new THREE.Vector3(...to).divideScalar(1000), speed: speeds[0] }];
    return Array.from({ length: PARTS }, (_, k) => {
      const part = (k + 1) / PARTS;
      const at = to.map((one, axis) => places[i - 1][axis] + part * (one - places[i - 1][axis]));
      return { at: new THREE.Vector3(...at).divideScalar(1000), speed: speeds[i - 1] + part * (speeds[i] - speeds[i - 1]) };
    });
  });
}

export class Ahead {
  readonly group = new THREE.Group();
  private readonly material = new LineMaterial({ vertexColors: true, linewidth: WIDTH });
  private ways: Point[][] = [];
  private fastest = 1;
  private passed = 0;  // points of the first way
  private drawn: number | null = null;  // points passed of it

  set(ways: Way[], fastest: number): void {
    this.ways = ways.filter(({ places }) => places.length > 1).map(points_of);
    this.fastest = fastest;
    this.passed = 0;
    this.drawn = null;
  }

  // `tip`: m. Returns whether the drawing has changed.
  move(tip: THREE.Vector3): boolean {
    const first = this.ways[0] ?? [];
    // After a change it may be anywhere on the way.
    const end = this.drawn === null ? first.length : Math.min(first.length, this.passed + WINDOW);
    let least = Infinity;
    for (let i = this.passed; i < end; i++) {
      const far = first[i].at.distanceTo(tip);
      if (far < least) {
        least = far;
        this.passed = i;
      }
    }
    if (this.passed === this.drawn) return false;
    this.drawn = this.passed;
    this.redraw();
    return true;
  }

  dispose(): void {
    this.clear();
    this.material.dispose();
  }

  private clear(): void {
    for (const line of this.group.children) (line as Line2).geometry.dispose();
    this.group.clear();
  }

  private redraw(): void {
    this.clear();
    this.ways.forEach((points, i) => {
      const left = i === 0 ? points.slice(this.passed) : points;
      if (left.length < 2) return;
      const geometry = new LineGeometry();
      geometry.setPositions(left.flatMap(({ at }) => at.toArray()));
      geometry.setColors(left.flatMap(({ speed }) => new THREE.Color(speed_rgb(speed / this.fastest)).toArray()));
      const line = new Line2(geometry, this.material);
      line.frustumCulled = false;
      this.group.add(line);
    });
  }
}
