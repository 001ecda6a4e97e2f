// SPDX-License-Identifier: Apache-2.0
// IFC to glTF: one node a product, named Class_Name, near the origin, in metres, Y up.
//
//     npm install web-ifc@0.0.78 @gltf-transform/core@4
//     node ifc_to_glb.mjs house.ifc house.glb
import {Document, NodeIO} from '@gltf-transform/core';
import {readFileSync} from 'node:fs';
import * as WebIFC from 'web-ifc';

const [input, output] = process.argv.slice(2);
if (!input || !output) {
    console.error('usage: node ifc_to_glb.mjs MODEL.ifc MODEL.glb');
    process.exit(2);
}

const api = new WebIFC.IfcAPI();
await api.Init();
const model = api.OpenModel(readFileSync(input), {COORDINATE_TO_ORIGIN: true});
if (model < 0) {
    console.error(`${input}: web-ifc cannot read it`);
    process.exit(3);
}

const document = new Document();
const buffer = document.createBuffer();
const scene = document.createScene();
const materials = new Map();

function materialOf({x, y, z, w}) {
    const key = [x, y, z, w].join();
    if (!materials.has(key)) {
        const material = document.createMaterial().setBaseColorFactor([x, y, z, w]).setDoubleSided(true);
        if (w < 1) material.setAlphaMode('BLEND');
        materials.set(key, material);
    }
    return materials.get(key);
}

/// Vertices of web-ifc are position and normal, six floats each.
function primitiveOf(geometry, color) {
    const vertices = api.GetVertexArray(geometry.GetVertexData(), geometry.GetVertexDataSize());
    const indices = api.GetIndexArray(geometry.GetIndexData(), geometry.GetIndexDataSize());
    const count = vertices.length / 6;
    const part = (first) => Float32Array.from({length: 3 * count},
                                              (_, i) => vertices[6 * Math.floor(i / 3) + first + i % 3]);
    const accessor = (type, array) => document.createAccessor().setType(type).setArray(array).setBuffer(buffer);
    return document.createPrimitive()
        .setAttribute('POSITION', accessor('VEC3', part(0)))
        .setAttribute('NORMAL', accessor('VEC3', part(3)))
        .setIndices(accessor('SCALAR', new Uint32Array(indices)))
        .setMaterial(materialOf(color));
}

// Openings and spaces are no bodies: the former are cut out of their walls already.
const isNoBody = new Set([WebIFC.IFCOPENINGELEMENT, WebIFC.IFCOPENINGSTANDARDCASE, WebIFC.IFCSPACE]);

api.StreamAllMeshes(model, (mesh) => {
    const product = api.GetLine(model, mesh.expressID);
    if (isNoBody.has(product.type)) return;
    const name = `${product.constructor.name}_${product.Name?.value ?? mesh.expressID}`;
    const node = document.createNode(name);
    scene.addChild(node);
    for (let i = 0; i < mesh.geometries.size(); ++i) {
        const placed = mesh.geometries.get(i);
        const geometry = api.GetGeometry(model, placed.geometryExpressID);
        if (geometry.GetIndexDataSize() > 0) {
            const body = document.createMesh(name).addPrimitive(primitiveOf(geometry, placed.color));
            node.addChild(document.createNode(name).setMesh(body).setMatrix(placed.flatTransformation));
        }
        geometry.delete();
    }
});
api.CloseModel(model);
await new NodeIO().write(output, document);
