// SPDX-License-Identifier: Apache-2.0
// How far a receiver has come in its tile's list and in the tree.

// A place in the work of a receiver. The tile's list is gone through from the plain nodes to the special ones, each with
// all below it, and then what of the tree did not fit into it.
struct Progress {
    int part;   // which group, of which lattice, of which patch
    uint next;  // of the list; one more than it has where we are beyond it
    Walk walk;  // below a node of the list: returnTo is where that ends
};

Progress startOf(int part, uint next) { return Progress(part, next, Walk(0u, 0u)); }

bool isBetweenNodes(Progress progress) { return progress.walk.node == progress.walk.returnTo; }
bool isPlainOver(Progress progress, TileList list) {
    return progress.next > list.plain || (progress.next == list.plain && isBetweenNodes(progress));
}
bool isListOver(Progress progress, TileList list) { return progress.next > list.plain + list.special; }
bool isOver(Progress progress, TileList list) {
    return isListOver(progress, list) && progress.walk.node == EXACT_END;
}

// To what did not fit into the list, where that is at its end.
Progress leaveList(Progress progress, TileList list) {
    if (progress.next != list.plain + list.special || !isBetweenNodes(progress)) return progress;
    return Progress(progress.part, progress.next + 1u, Walk(list.stoppedAt, list.returnTo));
}

// Triangles of a leaf that have not been looked at.
struct Leaf {
    uint next, end;
    bool hasHoles;
};
