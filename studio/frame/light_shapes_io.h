// SPDX-License-Identifier: Apache-2.0
// The values of penumbra::LightShape, for the studio's shaders and their C++.
#ifndef PENUMBRA_LIGHT_SHAPES_IO_H
#define PENUMBRA_LIGHT_SHAPES_IO_H

#ifdef __cplusplus
namespace penumbra::studio {
#endif

const int shapeRect = 0;
const int shapeDisk = 1;
const int shapeSphere = 2;
const int shapeDistant = 3;
const int shapeCylinder = 4;

#ifdef __cplusplus
}  // namespace penumbra::studio
#endif
#endif
