// SPDX-License-Identifier: Apache-2.0
#include "studio/reference/reference_cache.h"

#include <gtest/gtest.h>

#include <chrono>
#include <set>

#include "studio/image/atomic_file.h"
#include "studio/image/test_folder.h"
#include "studio/reference/test_scenes.h"

namespace penumbra::studio {
namespace {

namespace fs = std::filesystem;

struct Traced {
    ReferenceScene scene = Soup().rect(-1, 0, -1, 1, 1).scene();
    ReceiverImage receivers = repeated({0, 0, 0});
    AreaLight light = rectAt({0, 0, 2}, 1, 1);
    ReferenceOptions options{.samples = 16};
    int traces = 0;

    ReferenceResult through(ReferenceCache cache) {
        ReferenceOptions counting = options;
        counting.progress = [&](double fraction) { traces += fraction == 1.0; };
        return cache.trace(scene, receivers, light, nullptr, counting);
    }
};

fs::path onlyFileIn(const TestFolder& folder) {
    return fs::directory_iterator(folder.path())->path();
}

TEST(ReferenceCache, ASecondTraceComesFromDiskBitForBit) {
    const TestFolder folder;
    Traced traced;
    const ReferenceResult first = traced.through(ReferenceCache(folder.path()));
    const ReferenceResult second = traced.through(ReferenceCache(folder.path()));
    EXPECT_EQ(traced.traces, 1);
    EXPECT_EQ(first.visibility.values, second.visibility.values);
    EXPECT_EQ(first.noise_rms, second.noise_rms);
    EXPECT_EQ(first.rays, second.rays);
    EXPECT_EQ(folder.fileCount(), 1);
}

TEST(ReferenceCache, EveryInputHasItsOwnKey) {
    const Traced base;
    std::vector<ContentHash> keys;
    const auto add = [&](auto&& change, const RadianceTexture* texture = nullptr) {
        Traced traced;
        change(traced);
        keys.push_back(traceKey(traced.scene, traced.receivers, traced.light, texture, traced.options));
    };
    const RadianceTexture grey{Image(2, 2, 3, 0.5f)}, wide{Image(4, 1, 3, 0.5f)};
    add([](Traced&) {});
    add([](Traced&) {}, &grey);
    add([](Traced&) {}, &wide);
    add([](Traced& t) { t.scene = Soup().rect(-1, 0.001f, -1, 1, 1).scene(); });
    add([](Traced& t) { t.receivers.posWorld[9].z = 1e-6f; });
    add([](Traced& t) { t.receivers.normalWorld[9] = {1, 0, 0}; });
    add([](Traced& t) { t.receivers.valid[9] = 0; });
    add([](Traced& t) { t.receivers.eyeWorld.x = 1; });
    add([](Traced& t) { t.receivers = repeated({0, 0, 0}, {0, 0, 1}, 8, 32); });
    add([](Traced& t) { t.light.shape = LightShape::disk; });
    add([](Traced& t) { t.light.width_m = 1.5f; });
    add([](Traced& t) { t.light.height_m = 1.5f; });
    add([](Traced& t) { t.light.radius_m = 1.5f; });
    add([](Traced& t) { t.light.angle_rad = 1.5f; });
    add([](Traced& t) { t.light.twoSided = true; });
    add([](Traced& t) { t.light.worldFromLight.columns[3][0] = 1; });
    add([](Traced& t) { t.options.samples = 17; });
    add([](Traced& t) { t.options.seed = 2; });
    add([](Traced& t) { t.options.weight = ReferenceOptions::Weight::irradiance; });
    std::set<std::string> different;
    for (const ContentHash& key : keys) different.insert(key.hex());
    EXPECT_EQ(different.size(), keys.size());
    Traced same;
    EXPECT_EQ(traceKey(same.scene, same.receivers, same.light, nullptr, same.options), keys[0]);
}

TEST(ReferenceCache, ADamagedFileIsTracedAgain) {
    const TestFolder folder;
    Traced traced;
    const ReferenceResult first = traced.through(ReferenceCache(folder.path()));
    const std::vector<std::byte> good = readWholeFile(onlyFileIn(folder));
    int expectedTraces = 1;
    for (const std::size_t place : {std::size_t(0), std::size_t(9), std::size_t(30), good.size() - 1}) {
        std::vector<std::byte> bad = good;
        bad[place] ^= std::byte{1};
        writeFileAtomically(onlyFileIn(folder), bad);
        EXPECT_EQ(traced.through(ReferenceCache(folder.path())).visibility.values, first.visibility.values);
        EXPECT_EQ(traced.traces, ++expectedTraces) << place;
    }
    for (const std::size_t size : {std::size_t(0), std::size_t(79), std::size_t(80), good.size() - 4}) {
        writeFileAtomically(onlyFileIn(folder), std::span(good).first(size));
        EXPECT_EQ(traced.through(ReferenceCache(folder.path())).visibility.values, first.visibility.values);
        EXPECT_EQ(traced.traces, ++expectedTraces) << size;
    }
}

TEST(ReferenceCache, ForgetsWhatWasNotUsedForLongest) {
    const TestFolder folder;
    const ReferenceResult result{.visibility = Image(16, 16, 1, 0.5f)};
    const std::uint64_t fileSize = 80 + 16 * 16 * 4;
    ReferenceCache cache(folder.path(), 2 * fileSize);
    const auto backdate = [&](const ContentHash& key, int hours) {
        fs::last_write_time(folder / (key.hex() + ".visibility"),
                            fs::file_time_type::clock::now() - std::chrono::hours(hours));
    };
    const ContentHash a{1, 1}, b{2, 2}, c{3, 3};
    cache.store(a, result);
    backdate(a, 9);
    cache.store(b, result);
    backdate(b, 5);
    EXPECT_TRUE(cache.find(a));  // now a was used after b
    cache.store(c, result);
    EXPECT_FALSE(cache.find(b));
    EXPECT_TRUE(cache.find(a));
    EXPECT_TRUE(cache.find(c));
}

TEST(ReferenceCache, SweepsUpWhatAKilledProcessLeft) {
    const TestFolder folder;
    for (const char* name : {"old.tmp", "new.tmp"}) writeFileAtomically(folder / name, "half");
    fs::last_write_time(folder / "old.tmp", fs::file_time_type::clock::now() - std::chrono::hours(2));
    ReferenceCache(folder.path()).store({1, 1}, {.visibility = Image(2, 2, 1)});
    EXPECT_FALSE(fs::exists(folder / "old.tmp"));
    EXPECT_TRUE(fs::exists(folder / "new.tmp"));
}

TEST(ReferenceCache, AFolderThatCannotBeUsedDisablesIt) {
    const TestFolder folder;
    writeFileAtomically(folder / "file", "in the way");
    Traced traced;
    traced.through(ReferenceCache(folder / "file"));
    traced.through(ReferenceCache(folder / "file" / "below"));
    traced.through(ReferenceCache(fs::path()));
    EXPECT_EQ(traced.traces, 3);
    ReferenceCache vanished(folder / "gone");
    fs::remove(folder / "gone");
    EXPECT_NO_THROW(vanished.store({1, 1}, {.visibility = Image(2, 2, 1)}));
}

}  // namespace
}  // namespace penumbra::studio
