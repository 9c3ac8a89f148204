// A scene as three.js draws it: its surface, the edges of its cells and the arrows of its contact forces.
carom.SceneModel = (function () {
  "use strict";
  const ROWS = { field: 0.125, none: 0.375, parts: 0.625 };  // of the texture

  // One row of colours each: the field's, "no value", the parts'.
  function makeTexture(colouring) {
    const { none, parts } = carom.Colouring.palettes;
    const rows = [colouring.palette, [none], parts, [none]];
    const bytes = new Uint8Array(4 * 256 * 4);
    rows.forEach((row, r) => {
      for (let i = 0; i < 256; i++) bytes.set([...row[i % row.length], 255], 4 * (256 * r + i));
    });
    const texture = new THREE.DataTexture(bytes, 256, 4, THREE.RGBAFormat);
    texture.magFilter = texture.minFilter = THREE.NearestFilter;
    texture.needsUpdate = true;
    return texture;
  }

  const EDGE = 5;  // numbers of an edge

  // Every edge of a cell once: its nodes, the part of one of its cells, the frames from which and until which it is seen:
  // what has become an edge of the surface stays one until its last cell goes.
  function edgesOf(scene) {
    const seen = new Map(), edges = [];
    for (let k = 0; k < scene.triangles; k++) {
      for (let e = 0; e < 3; e++) {
        if (!(scene.edges[k] & (1 << e))) continue;
        const a = scene.node[e][k], b = scene.node[(e + 1) % 3][k];
        const key = Math.min(a, b) * scene.nodes + Math.max(a, b);
        const [from, until] = scene.changes ? [scene.from[k], scene.until[k]] : [0, scene.frames];
        const known = seen.get(key);
        if (known === undefined) {
          seen.set(key, edges.length);
          edges.push(a, b, scene.part[scene.cell[k]], from, until);
        } else {
          edges[known + 3] = Math.min(edges[known + 3], from);
          edges[known + 4] = Math.max(edges[known + 4], until);
        }
      }
    }
    return Uint32Array.from(edges);
  }

  function attribute(geometry, name, count, size) {
    const made = new THREE.BufferAttribute(new Float32Array(count * size), size);
    geometry.setAttribute(name, made.setUsage(THREE.DynamicDrawUsage));
    return made;
  }

  return class {
    constructor(scene, isObstacle, clipping) {
      this.scene = scene;
      this.isObstacle = isObstacle;
      this.hidden = new Set();
      const surface = new THREE.BufferGeometry();
      this.position = attribute(surface, "position", 3 * scene.triangles, 3);
      this.uv = attribute(surface, "uv", 3 * scene.triangles, 2);
      const everywhere = new THREE.Sphere(new THREE.Vector3(), Infinity);
      surface.boundingSphere = everywhere;
      const material = new THREE.MeshPhongMaterial({
        flatShading: true, side: THREE.DoubleSide, shininess: 0, clippingPlanes: clipping,
        polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1,
        ...(isObstacle ? { transparent: true, opacity: 0.35, depthWrite: false } : {}),
      });
      this.mesh = new THREE.Mesh(surface, material);
      this.edges = edgesOf(scene);
      const lines = new THREE.BufferGeometry();
      this.linePosition = attribute(lines, "position", (2 * this.edges.length) / EDGE, 3);
      lines.boundingSphere = everywhere;
      this.lines = new THREE.LineSegments(lines, new THREE.LineBasicMaterial({ color: isObstacle ? 0x808080 : 0x000000, transparent: true, opacity: isObstacle ? 0.6 : 0.45, clippingPlanes: clipping }));
      for (const object of [this.mesh, this.lines]) object.frustumCulled = false;
      this.objects = [this.mesh, this.lines];
      if (!isObstacle) this.makeArrows(clipping);
    }

    makeArrows(clipping) {
      this.force = this.scene.field("contact_force");
      if (!this.force || this.force.ranges.length !== 3) return (this.force = null);
      this.largestForce = Math.max(...new carom.Colouring(this.scene, this.force, -1).range);
      const { scene, force } = this;
      let most = 0;
      for (let t = 0; t < scene.frames; t++) {
        let count = 0;
        for (let i = 0; i < scene.nodes; i++) if (this.forceAt(t, i).lengthSq() > (1e-3 * this.largestForce) ** 2) count++;
        most = Math.max(most, count);
      }
      if (most === 0) return (this.force = null);
      const material = new THREE.MeshPhongMaterial({ color: 0xd0342c, shininess: 0, clippingPlanes: clipping });
      const shaft = new THREE.CylinderBufferGeometry(0.02, 0.02, 0.75, 8).translate(0, 0.375, 0);
      const head = new THREE.ConeBufferGeometry(0.06, 0.25, 12).translate(0, 0.875, 0);
      this.arrows = [shaft, head].map((geometry) => {
        const mesh = new THREE.InstancedMesh(geometry, material, most);
        mesh.frustumCulled = false;
        return mesh;
      });
      this.objects.push(...this.arrows);
    }

    forceAt(frame, i) {
      return new THREE.Vector3(...[0, 1, 2].map((c) => this.force.value(c, frame, i) || 0));
    }

    // Forces on the body end at their node: they push it.
    updateArrows(frame, at, longest) {
      if (!this.force) return;
      const up = new THREE.Vector3(0, 1, 0), turn = new THREE.Quaternion(), matrix = new THREE.Matrix4();
      let count = 0;
      for (let i = 0; i < this.scene.nodes; i++) {
        const force = this.forceAt(frame, i), size = force.length();
        if (!(size > 1e-3 * this.largestForce)) continue;
        const length = (longest * size) / this.largestForce, along = force.divideScalar(size);
        turn.setFromUnitVectors(up, along);
        const foot = new THREE.Vector3(at[0][i], at[1][i], at[2][i]).addScaledVector(along, -length);
        const width = Math.max(length, 0.25 * longest);
        matrix.compose(foot, turn, new THREE.Vector3(width, length, width));
        for (const arrow of this.arrows) arrow.setMatrixAt(count, matrix);
        count++;
      }
      for (const arrow of this.arrows) {
        arrow.count = count;
        arrow.instanceMatrix.needsUpdate = true;
      }
    }

    show({ frame, scale, colouring, edges, arrows, arrowLength }) {
      const { scene } = this;
      const at = carom.positions(scene, frame, scale);
      this.at = at;
      if (colouring !== this.colouring || colouring.palette !== this.palette) {
        if (this.mesh.material.map) this.mesh.material.map.dispose();
        this.mesh.material.map = makeTexture(colouring);
        this.mesh.material.needsUpdate = true;
        this.colouring = colouring;
        this.palette = colouring.palette;
      }
      const places = colouring.field ? colouring.places(frame) : null;
      const atCells = places && colouring.field.at === "cell";
      const position = this.position.array, uv = this.uv.array;
      for (let k = 0; k < scene.triangles; k++) {
        const cell = scene.cell[k], part = scene.part[cell], isHidden = this.hidden.has(part) || !scene.isSeen(k, frame);
        for (let a = 0; a < 3; a++) {
          const n = scene.node[isHidden ? 0 : a][k], v = 3 * k + a;
          for (let c = 0; c < 3; c++) position[3 * v + c] = at[c][n];
          const place = places ? places[atCells ? cell : n] : ((part % 8) + 0.5) / 256;
          uv[2 * v] = place < 0 ? 0.5 : places ? (0.5 + 255 * place) / 256 : place;
          uv[2 * v + 1] = !places ? (this.isObstacle ? ROWS.none : ROWS.parts) : place < 0 ? ROWS.none : ROWS.field;
        }
      }
      this.position.needsUpdate = this.uv.needsUpdate = true;
      this.showLines(at, frame, edges);
      if (this.force) for (const arrow of this.arrows) arrow.visible = arrows;
      if (arrows) this.updateArrows(frame, at, arrowLength);
    }

    showLines(at, frame, visible) {
      this.lines.visible = visible;
      if (!visible) return;
      const line = this.linePosition.array;
      for (let e = 0; e < this.edges.length / EDGE; e++) {
        const [, , part, from, until] = this.edges.subarray(EDGE * e, EDGE * (e + 1));
        const isHidden = this.hidden.has(part) || (this.scene.changes && (frame < from || frame >= until));
        for (let a = 0; a < 2; a++)
          for (let c = 0; c < 3; c++) line[6 * e + 3 * a + c] = at[c][this.edges[EDGE * e + (isHidden ? 0 : a)]];
      }
      this.linePosition.needsUpdate = true;
    }

    // What a ray meets first of what is shown: triangle, cell, nearest node.
    pick(raycaster, isShown) {
      const hit = raycaster.intersectObject(this.mesh).find((h) => isShown(h.point));
      if (!hit) return null;
      const k = hit.faceIndex, { at, scene } = this;
      const distance = (n) => (at[0][n] - hit.point.x) ** 2 + (at[1][n] - hit.point.y) ** 2 + (at[2][n] - hit.point.z) ** 2;
      const node = [0, 1, 2].map((a) => scene.node[a][k]).sort((a, b) => distance(a) - distance(b))[0];
      return { cell: scene.cell[k], node, distance: hit.distance };
    }
  };
})();
