// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <iostream>

#include "apps/penumbra/arguments.h"
#include "apps/penumbra/commands.h"
#include "apps/penumbra/measure_arguments.h"
#include "studio/errors.h"
#include "studio/image/atomic_file.h"
#include "studio/measure/measured_files.h"
#include "studio/measure/plan_of.h"
#include "studio/workbench/parameter_list.h"
#include "studio/workbench/progress.h"

namespace penumbra::studio {
namespace {

namespace fs = std::filesystem;

class MeasureCommand {
  public:
    MeasureCommand(const MeasureArguments& arguments, const std::string& commandLine)
        : arguments_(arguments), metadata_(pictureMetadata(commandLine)) {}

    void run() {
        checkOutputs();
        const Contender wanted = parseTechnique(arguments_.technique);
        MeasuringOptions options{.perLight = arguments_.perLight};
        SceneArguments sceneArguments = arguments_.scene;
        if (!arguments_.over.empty()) {
            options.day = day();
            // Opened under a sun that is up, in whose place those of the day come.
            const auto risen = std::ranges::find_if(
                options.day, [](const SunMoment& moment) { return moment.light.has_value(); });
            sceneArguments.sun.place = risen->place;
        }
        const Scene scene = sceneArguments.open();
        const SceneMoment moment = scene.at(arguments_.scene.time_s);
        PointSet set = arguments_.where(scene, moment);
        if (const auto rows = arguments_.wantedRows()) set.keepRows(rows->first, rows->second, "--rows");
        Measurement measurement = prepare(scene, moment, std::move(set), options);
        if (arguments_.merge.empty()) {
            measureIn(measurement, scene, moment, wanted, options);
        } else {
            mergeCsv(measurement, scene, {arguments_.merge.begin(), arguments_.merge.end()});
        }
        warnOf(measurement);
        write(measurement, scene, moment);
    }

  private:
    void checkOutputs() const {
        for (const std::string& file : {arguments_.csv, arguments_.plan}) {
            if (!file.empty()) requireWritableFolder(fs::path(file).parent_path());
        }
        if (arguments_.plan.empty()) return;
        requirePlanName(arguments_.plan);
        if (!arguments_.points.empty())
            throw UsageError("-o: a list of points has no plan; give --plane or --surface with --grid");
    }

    std::vector<SunMoment> day() const {
        const SunArguments& sun = arguments_.scene.sun;
        if (!sun.place) {
            throw InputError(
                "--over: which sun? Give place, day and zone, for instance "
                "--sun=52.52,13.405,2026-03-20T12:00+01:00");
        }
        return sunDay(arguments_.over, *sun.place,
                      {.north_deg = sun.north_deg, .refraction = !sun.noRefraction});
    }

    void measureIn(Measurement& measurement, const Scene& scene, const SceneMoment& moment,
                   const Contender& wanted, MeasuringOptions& options) const {
        Workbench workbench(arguments_.scene.device);
        const std::unique_ptr<Technique> technique = workbench.makeTechnique(wanted.technique);
        if (!technique->answersAtPoints()) {
            throw UsageError(fmt::format(
                "-t {}: this technique needs a picture; exact, auto and reference answer at points",
                wanted.technique));
        }
        setForMeasuring(*technique);
        for (const auto& [key, value] : wanted.settings) setParameter(*technique, key, value);
        for (const std::string& text : arguments_.settings) {
            const Setting setting = parseSetting(text);
            if (!setting.technique.empty() && setting.technique != wanted.technique)
                throw UsageError(
                    fmt::format("--set '{}': '{}' is not the technique of -t", text, setting.technique));
            setParameter(*technique, setting.key, setting.value);
        }
        workbench.open(scene);
        Progress progress("measure");
        options.progress = [&](double share) { progress.update(share); };
        Measurement prepared;
        if (arguments_.timedRuns > 0) prepared = measurement;
        measure(measurement, workbench, moment, *technique, options);
        if (arguments_.timedRuns > 0)
            measurement.cost =
                timeRuns(prepared, workbench, moment, *technique, options, arguments_.timedRuns);
    }

    static void warnOf(const Measurement& measurement) {
        const std::size_t inside = std::size_t(
            std::ranges::count_if(measurement.inside, [](const std::string& body) { return !body.empty(); }));
        if (inside > 0)
            spdlog::warn(
                "{} of {} points lie inside of bodies, the first in '{}': they are left out", inside,
                measurement.inside.size(),
                *std::ranges::find_if(measurement.inside, [](const auto& body) { return !body.empty(); }));
    }

    void write(const Measurement& measurement, const Scene& scene, const SceneMoment& moment) const {
        if (!arguments_.csv.empty()) writeFileAtomically(arguments_.csv, toCsv(measurement, scene));
        if (!arguments_.plan.empty())
            writePlan(arguments_.plan,
                      planOf(measurement, scene, moment, arguments_.scene.scene,
                             arguments_.scene.sun.place.value_or("")),
                      metadata_);
        if (arguments_.json) {
            printJson(std::cout, measurement, scene, {arguments_.scene.scene, arguments_.technique});
        } else {
            printTable(std::cout, measurement, scene);
        }
    }

    const MeasureArguments& arguments_;
    Metadata metadata_;
};

}  // namespace

void addMeasure(CLI::App& app, const std::string& commandLine) {
    CLI::App* command =
        app.add_subcommand("measure", "illuminance in lux at points, on a plane or a surface, over a day");
    auto arguments = std::make_shared<MeasureArguments>();
    arguments->addTo(*command);
    command->callback([arguments, commandLine] { MeasureCommand(*arguments, commandLine).run(); });
}

}  // namespace penumbra::studio
