// SPDX-License-Identifier: Apache-2.0
#version 450
// The exposure at which the unshadowed picture's mean is mid-grey: the same for every technique. One work group, so
// that the sums are always taken in the same order.
layout(local_size_x = 256) in;

layout(std430) writeonly buffer Exposure { float exposure; };
layout(std430) readonly buffer RowSums { vec2 rowSums[]; };

shared vec2 sums[256];

void main() {
    int self = int(gl_LocalInvocationID.x), rows = rowSums.length();
    vec2 sum = vec2(0.0);
    for (int row = self; row < rows; row += 256) sum += rowSums[row];
    sums[self] = sum;
    for (int width = 128; width > 0; width /= 2) {
        barrier();
        if (self < width) sums[self] += sums[self + width];
    }
    if (self == 0) {
        float mean = sums[0].y > 0.0 ? sums[0].x / sums[0].y : 0.0;
        exposure = mean > 0.0 ? 0.4 / mean : 1.0;
    }
}
