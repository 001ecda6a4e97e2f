// SPDX-License-Identifier: Apache-2.0
// Which slots of the plan a batch holds, and in which layers their maps are. Where compared samples are resident, they
// have the first layers, a slot each, and those of the deepest level come in batches through what is left.
#include "src/techniques/light_sampling/sampling_io.h"

layout(std430) readonly buffer Plan { SamplingPlan plan; };
layout(std140) uniform BatchBlock { BatchConstants batch; };

bool sharesWhatIsLeft() { return batch.isResident && batch.stage == stageOfDeepest; }

int slotsInBatch() { return sharesWhatIsLeft() ? max(batch.capacity - plan.stages[stageOfDeepest].x, 1) : batch.capacity; }
int firstSlot() { return plan.stages[batch.stage].x + batch.index * slotsInBatch(); }
int slotCount() { return clamp(plan.stages[batch.stage].y - batch.index * slotsInBatch(), 0, slotsInBatch()); }
int layerOf(int slot) {
    int resident = !batch.isResident ? 0 : plan.stages[stageOfDeepest].y > 0 ? plan.stages[stageOfDeepest].x : batch.capacity;
    return (slot < resident ? slot : slot - firstSlot() + (sharesWhatIsLeft() ? resident : 0)) * batch.faces;
}
