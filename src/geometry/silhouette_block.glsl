// SPDX-License-Identifier: Apache-2.0
// Requires silhouettes_io.h. Edges are worked on in blocks of 256; a block's silhouette edges are the bits of eight words.
const uint blockSize = 256u;
const uint wordsPerBlock = 8u;

struct Edge {
    uint a, b;
    uint firstFace, faceCount;
};

layout(std430) readonly buffer Edges { Edge edges[]; };
layout(std430) readonly buffer EdgeFaces { uint edgeFaces[]; };
layout(std430) readonly buffer Facings { int facings[]; };

layout(std140) uniform Constants { SilhouetteConstants mesh; };

// The sum over the edge's faces of (front: +1, back: -1) times (walks from a to b: +1, from b to a: -1).
int silhouetteWeight(Edge edge) {
    int weight = 0;
    for (uint i = edge.firstFace; i < edge.firstFace + edge.faceCount; ++i) {
        uint face = edgeFaces[i];
        int facing = facings[mesh.firstFacing + (face >> 1)];
        weight += (face & 1u) == 0u ? facing : -facing;
    }
    return weight;
}
