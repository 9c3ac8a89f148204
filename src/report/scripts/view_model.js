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

  class SceneModel {
    constructor(scene, isObstacle, clipping) {
      Object.assign(this, { scene, isObstacle, hidden: new Set() });
      const material = new THREE.MeshPhongMaterial({
        flatShading: true, side: THREE.DoubleSide, shininess: 0, clippingPlanes: clipping,
        polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1,
        ...(isObstacle ? { transparent: true, opacity: 0.35, depthWrite: false } : {}),
      });
      this.mesh = new THREE.Mesh(carom.changingGeometry(3 * scene.triangles, { position: 3, uv: 2 }), material);
      this.mesh.frustumCulled = false;
      this.edges = new carom.CellEdges(scene, isObstacle, clipping);
      this.arrows = isObstacle ? null : carom.ForceArrows.of(scene, clipping);
      this.objects = [this.mesh, this.edges.object, ...(this.arrows ? this.arrows.objects : [])];
    }

    show({ frame, scale, colouring, edges, arrows, arrowLength }) {
      this.at = carom.positions(this.scene, frame, scale);
      this.colourBy(colouring);
      this.showSurface(frame, colouring);
      this.edges.show(this.at, frame, this.hidden, edges);
      if (this.arrows) this.arrows.show(frame, this.at, arrowLength, arrows);
    }

    colourBy(colouring) {
      if (colouring === this.colouring && colouring.palette === this.palette) return;
      const { material } = this.mesh;
      if (material.map) material.map.dispose();
      material.map = makeTexture(colouring);
      material.needsUpdate = true;
      this.colouring = colouring;
      this.palette = colouring.palette;
    }

    // A triangle that is not seen is put into one of its corners.
    showSurface(frame, colouring) {
      const { scene, at } = this, { attributes } = this.mesh.geometry;
      const position = attributes.position.array, uv = attributes.uv.array;
      const places = colouring.field ? colouring.places(frame) : null;
      const atCells = places && colouring.field.at === "cell";
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
      attributes.position.needsUpdate = attributes.uv.needsUpdate = true;
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
  }

  return SceneModel;
})();
