// SPDX-License-Identifier: GPL-3.0-or-later
// Shows the building that the page holds (BUILDING, by turntable.cc) with three.js.
'use strict';
(function () {
  const bytesOf = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer;
  const canvas = document.getElementById('turn');
  const told = document.getElementById('turn-told');
  const center = BUILDING.center;
  const positions = new THREE.BufferAttribute(new Float32Array(bytesOf(BUILDING.positions)), 3);
  const scene = new THREE.Scene();
  scene.background = new THREE.Color(0xd4dbe6);
  scene.add(new THREE.HemisphereLight(0xffffff, 0x8a8478, 0.75));
  const sun = new THREE.DirectionalLight(0xffffff, 0.5);
  const camera = new THREE.PerspectiveCamera(40, 1, BUILDING.size / 1000, BUILDING.size * 20);
  camera.up.set(0, 0, 1);
  camera.position.set(-0.75, -1.1, 0.75).multiplyScalar(BUILDING.size);
  camera.add(sun);
  scene.add(camera);
  const renderer = new THREE.WebGLRenderer({canvas, antialias: true});
  renderer.outputEncoding = THREE.sRGBEncoding;
  const controls = new THREE.OrbitControls(camera, canvas);

  // One mesh a layer and material, its back apart, so that both can be told.
  const solids = [];
  const backs = [];
  for (const part of BUILDING.parts) {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', positions);
    geometry.setIndex(new THREE.BufferAttribute(new Uint32Array(bytesOf(part.triangles)), 1));
    const look = {
      color: new THREE.Color(...part.rgb), flatShading: true,
      transparent: part.opacity < 1, opacity: Math.max(part.opacity, 0.15),
    };
    const front = new THREE.Mesh(geometry, new THREE.MeshLambertMaterial({...look, side: THREE.FrontSide}));
    const back = new THREE.Mesh(geometry, new THREE.MeshLambertMaterial({...look, side: THREE.BackSide}));
    front.layer = back.layer = part.layer;
    back.own = back.material.color.clone();
    solids.push(front, back);
    backs.push(back);
    scene.add(front, back);
  }
  const edgePlaces = new THREE.BufferGeometry();
  edgePlaces.setAttribute('position', positions);
  edgePlaces.setIndex(new THREE.BufferAttribute(new Uint32Array(bytesOf(BUILDING.open_edges)), 1));
  const edges = new THREE.LineSegments(edgePlaces, new THREE.LineBasicMaterial({color: 0xd00000}));
  scene.add(edges);

  const draw = () => renderer.render(scene, camera);
  const fit = () => {
    const {clientWidth, clientHeight} = canvas;
    renderer.setSize(clientWidth, clientHeight, false);
    camera.aspect = clientWidth / clientHeight;
    camera.updateProjectionMatrix();
    draw();
  };
  controls.addEventListener('change', draw);
  window.addEventListener('resize', fit);

  const onChange = (id, act) => document.getElementById(id).addEventListener('change', (event) => {
    act(event.target.checked);
    draw();
  });
  onChange('turn-edges', (shown) => { edges.visible = shown; });
  onChange('turn-backs', (shown) => {
    for (const back of backs) back.material.color.copy(shown ? new THREE.Color(0xd000a0) : back.own);
  });
  const boxes = document.querySelectorAll('[data-layer]');
  const show = (box) => {
    for (const mesh of solids) if (mesh.layer === Number(box.dataset.layer)) mesh.visible = box.checked;
  };
  for (const box of boxes) {
    box.addEventListener('change', () => {
      show(box);
      draw();
    });
  }
  onChange('turn-all', (shown) => {
    for (const box of boxes) {
      box.checked = shown;
      show(box);
    }
  });

  // Two clicks measure; a drag turns and is none.
  let pressed = null;
  let last = null;
  canvas.addEventListener('pointerdown', (event) => { pressed = [event.clientX, event.clientY]; });
  canvas.addEventListener('pointerup', (event) => {
    if (!pressed || Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) > 3) return;
    const box = canvas.getBoundingClientRect();
    const at = new THREE.Vector2((event.clientX - box.left) / box.width * 2 - 1,
      1 - (event.clientY - box.top) / box.height * 2);
    const ray = new THREE.Raycaster();
    ray.setFromCamera(at, camera);
    const hit = ray.intersectObjects(solids.filter((mesh) => mesh.visible))[0];
    if (!hit) return;
    const place = hit.point.toArray().map((value, i) => (value + center[i]).toFixed(3)).join(', ');
    const step = last && hit.point.clone().sub(last);
    told.textContent = `${BUILDING.layers[hit.object.layer]} at (${place}) m` + (step ?
      `; ${step.length().toFixed(3)} m from the last point, ${Math.hypot(step.x, step.y).toFixed(3)} m along and ` +
      `${step.z.toFixed(3)} m up` : '; click a second point to measure');
    last = hit.point;
  });
  fit();
})();
