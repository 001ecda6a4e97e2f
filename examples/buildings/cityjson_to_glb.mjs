// SPDX-License-Identifier: Apache-2.0
// CityJSON (1.0 to 2.0) to glTF: one node an object of the city, named Type_identifier, of its finest level of detail, near the
// origin, in metres, Y up. Without textures; a surface is coloured by what it is.
//
//     npm install earcut@3 @gltf-transform/core@4
//     node cityjson_to_glb.mjs town.city.json town.glb
import {Document, NodeIO} from '@gltf-transform/core';
import earcut from 'earcut';
import {readFileSync} from 'node:fs';

const [input, output] = process.argv.slice(2);
if (!input || !output) {
    console.error('usage: node cityjson_to_glb.mjs TOWN.city.json TOWN.glb');
    process.exit(2);
}
const city = JSON.parse(readFileSync(input, 'utf8'));
if (city.type !== 'CityJSON') {
    console.error(`${input}: is no CityJSON`);
    process.exit(3);
}

// Places in metres: differences to the first vertex are small, whatever the country's coordinates.
const scale = city.transform?.scale ?? [1, 1, 1];
const middle = [0, 1].map((axis) => {
    const [low, high] = city.vertices.reduce(([l, h], v) => [Math.min(l, v[axis]), Math.max(h, v[axis])], [Infinity, -Infinity]);
    return Math.round((low + high) / 2);
});
const ground = city.vertices.reduce((low, v) => Math.min(low, v[2]), Infinity);
const placeOf = (index) => {
    const [x, y, z] = city.vertices[index];
    return [(x - middle[0]) * scale[0], (y - middle[1]) * scale[1], (z - ground) * scale[2]];
};

// How deep the boundaries of a geometry lie: what is left are surfaces, lists of rings.
const depthOf = {MultiSurface: 0, CompositeSurface: 0, Solid: 1, MultiSolid: 2, CompositeSolid: 2};
function surfacesOf(geometry) {
    if (!(geometry.type in depthOf)) return [];
    const depth = depthOf[geometry.type];
    const kinds = geometry.semantics?.values?.flat(depth) ?? [];
    return geometry.boundaries.flat(depth).map(
        (rings, i) => ({rings, kind: geometry.semantics?.surfaces?.[kinds[i]]?.type ?? ''}));
}

// Newell's normal: not unit, and right for polygons that are not quite flat.
function normalOf(ring) {
    const normal = [0, 0, 0];
    ring.forEach((a, i) => {
        const b = ring[(i + 1) % ring.length];
        for (let axis = 0; axis < 3; ++axis) {
            const [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
            normal[axis] += (a[u] - b[u]) * (a[v] + b[v]);
        }
    });
    return normal;
}

// Triangles of a surface with holes, cut along the axis that it faces most.
function trianglesOf(rings) {
    const places = rings.map((ring) => ring.map(placeOf));
    const normal = normalOf(places[0]);
    const axis = normal.map(Math.abs).indexOf(Math.max(...normal.map(Math.abs)));
    const [u, v] = normal[axis] > 0 ? [(axis + 1) % 3, (axis + 2) % 3] : [(axis + 2) % 3, (axis + 1) % 3];
    const holes = [];
    places.slice(0, -1).reduce((count, ring) => (holes.push(count + ring.length), count + ring.length), 0);
    const all = places.flat();
    return earcut(all.flatMap((place) => [place[u], place[v]]), holes).map((i) => all[i]);
}

const colors = {RoofSurface: [0.55, 0.25, 0.2], GroundSurface: [0.4, 0.4, 0.4], Window: [0.6, 0.7, 0.8]};
const document = new Document(), buffer = document.createBuffer(), scene = document.createScene();
const materials = new Map();
function materialOf(kind) {
    if (!materials.has(kind)) {
        const color = colors[kind] ?? [0.75, 0.73, 0.7];
        materials.set(kind, document.createMaterial(kind).setBaseColorFactor([...color, 1]).setMetallicFactor(0).setDoubleSided(true));
    }
    return materials.get(kind);
}

let left = 0;
for (const [identifier, object] of Object.entries(city.CityObjects)) {
    const geometries = (object.geometry ?? []).filter(({type}) => type in depthOf);
    left += (object.geometry ?? []).length - geometries.length;
    const finest = geometries.sort((a, b) => Number(b.lod ?? 0) - Number(a.lod ?? 0))[0];
    if (!finest) continue;
    const positions = new Map();
    for (const {rings, kind} of surfacesOf(finest)) {
        if (!positions.has(kind)) positions.set(kind, []);
        // Z up to Y up.
        for (const [x, y, z] of trianglesOf(rings)) positions.get(kind).push(x, z, -y);
    }
    const mesh = document.createMesh(identifier);
    for (const [kind, numbers] of positions) {
        if (numbers.length === 0) continue;
        const accessor = document.createAccessor().setType('VEC3').setArray(new Float32Array(numbers)).setBuffer(buffer);
        mesh.addPrimitive(document.createPrimitive().setAttribute('POSITION', accessor).setMaterial(materialOf(kind)));
    }
    scene.addChild(document.createNode(`${object.type}_${identifier}`).setMesh(mesh));
}
if (left > 0) console.error(`${input}: ${left} geometries are left out: points, lines or instances of templates`);
await new NodeIO().write(output, document);
