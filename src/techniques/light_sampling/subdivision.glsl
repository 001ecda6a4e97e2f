// SPDX-License-Identifier: Apache-2.0
// Finding one's way in the quadtree. Includer declares `subdivision`.
int quadIndex(int level, ivec2 quad) { return ((1 << (2 * level)) - 1) / 3 + quad.y * (1 << level) + quad.x; }

bool quadExists(int level, ivec2 quad) {
    return level == 0 || subdivision.split[quadIndex(level - 1, quad / 2)] != 0u;
}

bool isLeaf(int level, ivec2 quad) {
    return quadExists(level, quad) && (level == deepestLevel || subdivision.split[quadIndex(level, quad)] == 0u);
}
