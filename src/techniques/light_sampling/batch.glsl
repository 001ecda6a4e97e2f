// SPDX-License-Identifier: Apache-2.0
// Which slots of the plan a batch holds, and in which layers their maps are. Includer defines PLAN_BLOCK.
#include "src/techniques/light_sampling/sampling_io.h"

layout(std430, binding = PLAN_BLOCK) readonly buffer Plan { SamplingPlan plan; };

layout(location = 0) uniform int stage;
layout(location = 1) uniform int batchStart;  // slots of the stage before this batch
layout(location = 2) uniform int capacity;    // slots in a batch
layout(location = 3) uniform int faces;       // maps a slot
layout(location = 4) uniform bool isResident; // every slot has layers of its own; else batches share them

int firstSlot() { return plan.stages[stage].x + batchStart; }
int slotCount() { return clamp(plan.stages[stage].y - batchStart, 0, capacity); }
int layerOf(int slot) { return (isResident ? slot : slot - firstSlot()) * faces; }
