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
  let renderer;
  try {
    renderer = new THREE.WebGLRenderer({canvas, antialias: true});
  } catch (error) {
    told.textContent = 'This browser has no WebGL, by which the building is turned: another one shows it.';
    return;
  }
  renderer.outputEncoding = THREE.sRGBEncoding;
  const controls = new THREE.OrbitControls(camera, canvas);

  // Two meshes a material, fronts and backs, so that both can be told; their triangles are in runs of layers, of which
  // those that are shown are copied together.
  const numbersOf = (text) => new Uint32Array(bytesOf(text));
  const isShown = new Uint8Array(BUILDING.layers.length).fill(1);
  const parts = BUILDING.parts.map((part) => {
    const all = numbersOf(part.triangles);
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', positions);
    geometry.setIndex(new THREE.BufferAttribute(all.slice(), 1));
    const look = {
      color: new THREE.Color(...part.rgb), flatShading: true,
      transparent: part.opacity < 1, opacity: Math.max(part.opacity, 0.15),
    };
    const front = new THREE.Mesh(geometry, new THREE.MeshLambertMaterial({...look, side: THREE.FrontSide}));
    const back = new THREE.Mesh(geometry, new THREE.MeshLambertMaterial({...look, side: THREE.BackSide}));
    scene.add(front, back);
    return {all, runs: numbersOf(part.runs), geometry, front, back, own: back.material.color.clone(), ends: []};
  });
  const update = () => {
    for (const part of parts) {
      const {all, runs, geometry} = part;
      let to = 0;
      part.ends = [];  // of the runs that are shown, with their layers
      for (let run = 0, from = 0; run < runs.length; run += 2) {
        const end = from + 3 * runs[run + 1];
        if (isShown[runs[run]]) {
          geometry.index.array.set(all.subarray(from, end), to);
          to += end - from;
          part.ends.push([to, runs[run]]);
        }
        from = end;
      }
      geometry.setDrawRange(0, to);
      geometry.index.needsUpdate = true;
    }
  };
  const layerOf = (hit) => {
    const part = parts.find(({front, back}) => front === hit.object || back === hit.object);
    return BUILDING.layers[part.ends.find(([end]) => 3 * hit.faceIndex < end)[1]];
  };
  const edgePlaces = new THREE.BufferGeometry();
  edgePlaces.setAttribute('position', positions);
  edgePlaces.setIndex(new THREE.BufferAttribute(new Uint32Array(bytesOf(BUILDING.open_edges)), 1));
  const edges = new THREE.LineSegments(edgePlaces, new THREE.LineBasicMaterial({color: 0xd00000}));
  scene.add(edges);

  // From the last point to this one, seen through walls.
  const measured = new THREE.BufferGeometry();
  const line = new THREE.Line(measured, new THREE.LineBasicMaterial({color: 0x0050d0, depthTest: false}));
  const ends = new THREE.Points(measured, new THREE.PointsMaterial(
    {color: 0x0050d0, size: 7, sizeAttenuation: false, depthTest: false}));
  line.renderOrder = ends.renderOrder = 1;
  line.visible = ends.visible = false;
  scene.add(line, ends);
  const measure = (from, to) => {
    measured.setFromPoints(from ? [from, to] : [to]);
    line.visible = Boolean(from);
    ends.visible = true;
  };

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
    for (const {back, own} of parts) back.material.color.copy(shown ? new THREE.Color(0xd000a0) : own);
  });

  // Of many layers those are listed that are named as asked for, the first ones.
  const MOST_LISTED = 300;
  const SOME = 20;
  const allBox = document.getElementById('turn-all');
  const name = document.getElementById('turn-name');
  const list = document.getElementById('turn-layers');
  const more = document.getElementById('turn-more');
  document.getElementById('turn-find').hidden = BUILDING.layers.length <= SOME;
  const keys = BUILDING.layers.map((layer) => layer.toLowerCase());
  let named = [];
  const tellAll = () => {
    const shown = named.filter((layer) => isShown[layer]).length;
    allBox.checked = shown === named.length;
    allBox.indeterminate = shown > 0 && shown < named.length;
    document.getElementById('turn-all-said').textContent = name.value.trim() ? 'all layers named so' : 'all layers';
  };
  const boxOf = (layer) => {
    const label = document.createElement('label');
    const box = document.createElement('input');
    box.type = 'checkbox';
    box.checked = isShown[layer] === 1;
    box.dataset.layer = layer;
    box.addEventListener('change', () => {
      isShown[layer] = box.checked ? 1 : 0;
      tellAll();
      update();
      draw();
    });
    label.append(box, ' ' + BUILDING.layers[layer]);
    return label;
  };
  const listLayers = () => {
    const key = name.value.trim().toLowerCase();
    named = keys.flatMap((own, layer) => (own.includes(key) ? [layer] : []));
    list.replaceChildren(...named.slice(0, MOST_LISTED).map(boxOf));
    more.hidden = named.length <= MOST_LISTED;
    more.textContent = `and ${named.length - MOST_LISTED} more: a part of their name finds them`;
    tellAll();
  };
  name.addEventListener('input', listLayers);
  onChange('turn-all', (shown) => {
    for (const layer of named) isShown[layer] = shown ? 1 : 0;
    listLayers();
    update();
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
    const hit = ray.intersectObjects(parts.flatMap(({front, back}) => [front, back]))[0];
    if (!hit) return;
    const place = hit.point.toArray().map((value, i) => (value + center[i]).toFixed(3)).join(', ');
    const step = last && hit.point.clone().sub(last);
    told.textContent = `${layerOf(hit)} at (${place}) m` + (step ?
      `; ${step.length().toFixed(3)} m from the last point, ${Math.hypot(step.x, step.y).toFixed(3)} m along and ` +
      `${step.z.toFixed(3)} m up` : '; click a second point to measure');
    measure(last, hit.point);
    last = hit.point;
    draw();
  });
  listLayers();
  update();
  fit();
})();
