// Geometry for three.js whose numbers change with the time. count vertices, and how many numbers each has by name.
carom.changingGeometry = function (count, sizes) {
  "use strict";
  const geometry = new THREE.BufferGeometry();
  for (const [name, size] of Object.entries(sizes)) {
    const numbers = new THREE.BufferAttribute(new Float32Array(count * size), size);
    geometry.setAttribute(name, numbers.setUsage(THREE.DynamicDrawUsage));
  }
  geometry.boundingSphere = new THREE.Sphere(new THREE.Vector3(), Infinity);  // wherever it goes, it is drawn
  return geometry;
};
