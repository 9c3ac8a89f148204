// A scene as three.js draws it: its surface, the edges of its cells and the arrows of its contact forces.
carom.SceneModel = (function () {
  "use strict";
  const ROWS = { field: 0.125, none: 0.375, parts: 0.625, above: 0.875 };  // of the texture

  // One row of colours each: the field's, "no value", the parts', above the limit.
  function makeTexture(palette) {
    const { none, parts, above } = carom.ColourScale.palettes;
    const rows = [palette, [none], parts, [above]];
    const bytes = new Uint8Array(4 * 256 * 4);
    rows.forEach((row, r) => {
      for (let i = 0; i < 256; i++) bytes.set([...row[i % row.length], 255], 4 * (256 * r + i));
    });
    const texture = new THREE.DataTexture(bytes, 256, 4, THREE.RGBAFormat);
    texture.magFilter = texture.minFilter = THREE.NearestFilter;
    texture.needsUpdate = true;
    return texture;
  }

  // Where the colour of a place on the scale stands in the texture.
  const across = (place) => (place < 0 || place > 1 ? 0.5 : (0.5 + 255 * place) / 256);
  const rowOf = (place) => (place < 0 ? ROWS.none : place > 1 ? ROWS.above : ROWS.field);

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
      this.colourBy(colouring.scale);
      this.showSurface(frame, colouring);
      this.edges.show(this.at, frame, this.hidden, edges);
      if (this.arrows) this.arrows.show(frame, this.at, arrowLength, arrows);
    }

    colourBy({ palette }) {
      if (palette === this.palette) return;
      const { material } = this.mesh;
      if (material.map) material.map.dispose();
      material.map = makeTexture(palette);
      material.needsUpdate = true;
      this.palette = palette;
    }

    // A triangle that is not seen is put into one of its corners.
    showSurface(frame, colouring) {
      const { scene, at } = this, { attributes } = this.mesh.geometry;
      const position = attributes.position.array, uv = attributes.uv.array;
      const places = colouring.field ? colouring.places(frame) : null;
      for (let k = 0; k < scene.triangles; k++) {
        const cell = scene.cell[k], part = scene.part[cell], isHidden = !this.isSeen(k, frame);
        for (let a = 0; a < 3; a++) {
          const n = scene.node[isHidden ? 0 : a][k], v = 3 * k + a;
          for (let c = 0; c < 3; c++) position[3 * v + c] = at[c][n];
          uv[2 * v] = places ? across(places[v]) : ((part % 8) + 0.5) / 256;
          uv[2 * v + 1] = places ? rowOf(places[v]) : this.isObstacle ? ROWS.none : ROWS.parts;
        }
      }
      attributes.position.needsUpdate = attributes.uv.needsUpdate = true;
    }

    // Is a triangle of this frame seen from somewhere?
    isSeen(k, frame) {
      return !this.hidden.has(this.scene.part[this.scene.cell[k]]) && this.scene.isSeen(k, frame);
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
