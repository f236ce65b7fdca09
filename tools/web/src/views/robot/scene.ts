// SPDX-License-Identifier: Apache-2.0
// The arm in 3-D: floor, light, camera, zones, frames, belts, and the path of the tool that it has taken and will take (on the workpiece, if
// axes move that). It is drawn only after a change.

import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import type { Robot } from "../../api/types";
import { colour } from "../../shell/theme";
import { Ahead } from "./ahead";
import { arm_of, type Arm } from "./arm";
import type { Carried, Way } from "./state";
import { Surroundings } from "./surroundings";
import { Zones } from "./zones";

const PATH_POINTS = 3000;
const LINKS = "#5b9bd9";  // visible on a light and a dark background
const HUBS = "#8d98a6";
export const VIEWS: Record<string, [number, number, number]> = {
  Corner: [1.0, -1.05, 0.65], Front: [1.8, 0, 0.25], Side: [0, -1.8, 0.25], Top: [0.001, 0, 2.2],
};

export class Scene {
  private readonly scene = new THREE.Scene();
  private readonly camera = new THREE.PerspectiveCamera(40, 1, 0.01, 200);
  private readonly renderer: THREE.WebGLRenderer;
  private readonly controls: OrbitControls;
  private readonly links = new THREE.MeshStandardMaterial({ roughness: 0.5, metalness: 0.1 });
  private readonly hubs = new THREE.MeshStandardMaterial({ roughness: 0.6, metalness: 0.2 });
  private readonly points = new Float32Array(PATH_POINTS * 3);
  private readonly path: THREE.Line;
  private readonly ahead = new Ahead();
  private zones: Zones | null = null;
  private surroundings: Surroundings | null = null;
  private grid: THREE.GridHelper | null = null;
  private arm: Arm | null = null;
  private used = 0;
  private requested = 0;
  private moved = false;
  private readonly watch: ResizeObserver;

  constructor(private readonly box: HTMLElement) {
    this.renderer = new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
    this.renderer.setPixelRatio(Math.min(2, devicePixelRatio));
    box.append(this.renderer.domElement);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, this.renderer.domElement);
    this.controls.addEventListener("change", () => this.draw());
    const sun = new THREE.DirectionalLight(0xffffff, 2);
    sun.position.set(2, -3, 5);
    this.scene.add(new THREE.HemisphereLight(0xffffff, 0x556070, 1.8), sun);
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(this.points, 3));
    this.path = new THREE.Line(geometry, new THREE.LineBasicMaterial());
    this.path.frustumCulled = false;
    this.scene.add(this.path);
    this.watch = new ResizeObserver(() => this.resize());
    this.watch.observe(box);
  }

  load(robot: Robot): Arm {
    if (this.arm) this.scene.remove(this.arm.robot);
    this.arm = arm_of(robot.urdf, this.links, this.hubs);
    this.zones = new Zones(this.arm, robot);
    this.surroundings = new Surroundings(this.arm, robot);
    this.scene.add(this.arm.robot);
    this.arm.base.add(this.path, this.ahead.group);
    this.clear_path();
    this.recolour();
    this.set_view("Corner");
    return this.arm;
  }

  // `values` are rad and m, in the order of the axes; `tip` is that of the held tool as commanded, mm. Each call extends the
  // path of the tool.
  move(values: number[], tip: number[], tool: number): void {
    if (!this.arm) return;
    this.arm.axes.forEach((joint, i) => { if (Number.isFinite(values[i])) joint.setJointValue(values[i]); });
    this.arm.robot.updateMatrixWorld(true);
    const at = tip.length === 3 && tip.every(Number.isFinite) ? new THREE.Vector3(...tip).divideScalar(1000)
      : this.arm.base.worldToLocal(this.arm.tool.getWorldPosition(new THREE.Vector3()));
    this.zones?.hold(tool);
    this.ahead.move(at);
    const last = this.used > 0 ? new THREE.Vector3().fromArray(this.points, (this.used - 1) * 3) : null;
    this.moved = true;
    if (!last || last.distanceTo(at) > this.arm.size * 5e-4) this.add_point(at);
    this.draw();
  }

  // `fastest`: the end of the scale of colours, mm/s.
  set_ways(ways: Way[], fastest: number): void {
    this.ahead.set(ways, fastest);
    if (ways.length === 0) this.ahead.move(new THREE.Vector3());
    this.renderer.domElement.dataset.ways = String(ways.length);
    this.draw();
  }

  show_zones(shown: boolean): void {
    this.zones?.show(shown);
    this.renderer.domElement.dataset.zones = String(shown);
    this.draw();
  }

  show_frames(shown: boolean): void {
    this.surroundings?.show(shown);
    this.renderer.domElement.dataset.frames = String(shown);
    this.draw();
  }

  carry(carried: Carried): void {
    const tracked = this.surroundings?.carry(carried) ?? false;
    this.renderer.domElement.dataset.tracked = String(tracked);
    this.draw();
  }

  // `used`: how many places of each pallet.
  use(used: number[]): void {
    this.surroundings?.use(used);
    this.renderer.domElement.dataset.used = used.join();
    this.draw();
  }

  clear_path(): void {
    this.used = 0;
    this.path.geometry.setDrawRange(0, 0);
    this.draw();
  }

  set_view(from: string): void {
    const reach = this.arm?.size ?? 1;
    const middle = new THREE.Vector3(reach * 0.15, 0, reach * 0.4);
    this.controls.target.copy(middle);
    this.camera.position.copy(middle).add(new THREE.Vector3(...(VIEWS[from] ?? VIEWS.Corner)).multiplyScalar(reach));
    this.controls.update();
    this.draw();
  }

  zoom(factor: number): void {
    this.camera.position.sub(this.controls.target).multiplyScalar(factor).add(this.controls.target);
    this.controls.update();
    this.draw();
  }

  recolour(): void {
    this.scene.background = new THREE.Color(colour("panel"));
    this.links.color.set(LINKS);
    this.hubs.color.set(HUBS);
    this.zones?.recolour();
    this.surroundings?.recolour();
    (this.path.material as THREE.LineBasicMaterial).color.set(colour("c1"));
    if (this.grid) this.scene.remove(this.grid);
    this.grid = new THREE.GridHelper((this.arm?.size ?? 1) * 3, 24, colour("quiet"), colour("line"));
    this.grid.rotateX(Math.PI / 2);
    this.scene.add(this.grid);
    this.draw();
  }

  end(): void {
    cancelAnimationFrame(this.requested);
    this.watch.disconnect();
    this.controls.dispose();
    this.ahead.dispose();
    this.renderer.dispose();
    this.renderer.domElement.remove();
  }

  private add_point(at: THREE.Vector3): void {
    if (this.used === PATH_POINTS) {
      this.points.copyWithin(0, 3 * PATH_POINTS / 2);
      this.used = PATH_POINTS / 2;
    }
    at.toArray(this.points, this.used * 3);
    this.used++;
    this.path.geometry.attributes.position.needsUpdate = true;
    this.path.geometry.setDrawRange(0, this.used);
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.box;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.camera.aspect = clientWidth / clientHeight;
    this.camera.updateProjectionMatrix();
    this.renderer.setSize(clientWidth, clientHeight);
    this.draw();
  }

  private draw(): void {
    if (this.requested) return;
    this.requested = requestAnimationFrame(() => {
      this.requested = 0;
      this.renderer.render(this.scene, this.camera);
      if (this.moved) this.renderer.domElement.dataset.drawn = "true";
    });
  }
}
