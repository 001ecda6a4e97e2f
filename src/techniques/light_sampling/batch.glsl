// SPDX-License-Identifier: Apache-2.0
// Which slots of the plan a batch holds, and in which layers their maps are.
#include "src/techniques/light_sampling/sampling_io.h"

layout(std430) readonly buffer Plan { SamplingPlan plan; };
layout(std140) uniform BatchBlock { BatchConstants batch; };

int firstSlot() { return plan.stages[batch.stage].x + batch.slotsBefore; }
int slotCount() { return clamp(plan.stages[batch.stage].y - batch.slotsBefore, 0, batch.capacity); }
int layerOf(int slot) { return (batch.isResident ? slot : slot - firstSlot()) * batch.faces; }
