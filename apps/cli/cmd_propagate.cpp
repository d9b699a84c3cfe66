// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <mutex>
#include <optional>

#include "commands.h"
#include "hogel/communicator.h"
#include "hogel/parameters.h"
#include "hogel/pipeline.h"
#include "hogel/propagate.h"
#include "hogel/units.h"
#include "inputs.h"
#include "outputs.h"

namespace hogel::cli {
namespace {

struct Options {
    std::string input, output;
    PropagateParameters plane;
    FieldParameters field;
    bool resume = false;
};

// Returns whether a file name always stands for an array of fields; .exr files may also be pictures.
bool is_array_name(const std::filesystem::path& path) {
    for (const char* ending : {".npy", ".npz", ".mat"})
        if (path.extension() == ending) return true;
    return false;
}

enum class OutputKind { hologram, array, picture };

OutputKind output_kind(const std::filesystem::path& path, const std::string& display) {
    if (path.extension() == ".h5" || path.extension() == ".hdf5") return OutputKind::hologram;
    if (display == "field" || is_array_name(path)) {
        with_parameter("display", [&] { require_fields_name(path); });
        return OutputKind::array;
    }
    require_picture_name(path);
    return OutputKind::picture;
}

void require_one_wavelength(const Fields& fields) {
    if (fields.size() != 1)
        throw Error(ErrorCode::usage, "display",
                    fmt::format("phase needs a single wavelength, but the hologram has {}", fields.size()));
}

// Accumulates |F|² of samples, for their mean. Thread-safe.
class MeanIntensity {
  public:
    void add(View<const std::complex<float>, 2> samples) {
        double sum = 0;
        for (const std::complex<float>& sample : samples.elements()) sum += std::norm(std::complex<double>(sample));
        const std::lock_guard lock(mutex_);
        sum_ += sum;
        count_ += samples.size();
    }
    double sum() const { return sum_; }
    std::size_t count() const { return count_; }
    // Adds the sums of the other ranks; the result is complete only on the root.
    void gather() {
        Communicator* const ranks = communicator();
        if (ranks == nullptr) return;
        const double local[] = {sum_, static_cast<double>(count_)};
        if (!ranks->is_root()) return ranks->send_to(0, {reinterpret_cast<const char*>(local), sizeof local});
        for (std::size_t rank = 1; rank < ranks->size(); ++rank) {
            double received[2] = {};
            const std::string bytes = ranks->receive_from(rank);
            std::memcpy(received, bytes.data(), std::min(bytes.size(), sizeof received));
            sum_ += received[0];
            count_ += static_cast<std::size_t>(received[1]);
        }
    }

  private:
    std::mutex mutex_;
    double sum_ = 0;
    std::size_t count_ = 0;
};

// Field source that measures the intensity of the samples read.
class MeasuredSource final : public FieldSource {
  public:
    MeasuredSource(const FieldSource& source, MeanIntensity& light) : source_(source), intensity_(light) {}
    const FieldGrid& grid() const override { return source_.grid(); }
    std::size_t looks() const override { return source_.looks(); }
    const Provenance& provenance() const override { return source_.provenance(); }
    std::size_t alignment() const override { return source_.alignment(); }
    std::size_t overlap() const override { return source_.overlap(); }
    void read(const Region& region, std::size_t look, View<std::complex<float>, 2> out) const override {
        source_.read(region, look, out);
        intensity_.add(out);
    }

  private:
    const FieldSource& source_;
    MeanIntensity& intensity_;
};

// Sink that measures the intensity of the samples written.
class MeasuredSink final : public FieldSink {
  public:
    MeasuredSink(FieldSink& sink, MeanIntensity& light) : sink_(sink), intensity_(light) {}
    void write(const Region& region, View<const std::complex<float>, 2> values) override {
        sink_.write(region, values);
        intensity_.add(values);
    }
    View<std::complex<float>, 2> in_memory() override { return sink_.in_memory(); }
    bool has_already(const Region& region) override { return sink_.has_already(region); }
    void finish() override { sink_.finish(); }

  private:
    FieldSink& sink_;
    MeanIntensity& intensity_;
};

// Propagates a field and returns the fraction of its light within the output. Returns nothing if an interrupted run has
// written a part of the output, for a field without light, and for a copy, which ranks share in another way.
std::optional<double> propagate_measured(const FieldSource& field, double distance, FieldSink& sink,
                                         const PropagateOptions& options, const Progress& progress) {
    const Grid &plane = field.grid().plane, &output = *options.output;
    if (distance == 0 && output == plane) {
        hogel::propagate(field, distance, sink, options, progress);
        return {};
    }
    MeanIntensity input_intensity, output_intensity;
    MeasuredSink measured(sink, output_intensity);
    hogel::propagate(MeasuredSource(field, input_intensity), distance, measured, options, progress);
    input_intensity.gather();
    output_intensity.gather();
    if (!(input_intensity.sum() > 0) || output_intensity.count() != output.samples()) return {};
    // Each tile reads the entire field once.
    const double light =
        input_intensity.sum() / static_cast<double>(input_intensity.count()) * plane.size_x() * plane.size_y();
    // Rounds to digits that do not depend on the order of summation in threads.
    return std::round(output_intensity.sum() * output.pitch_x * output.pitch_y / light * 1e9) / 1e9;
}

FieldQuantity quantity_of(const std::string& display) {
    return display == "phase"       ? FieldQuantity::phase
           : display == "amplitude" ? FieldQuantity::amplitude
                                    : FieldQuantity::intensity;
}

// @param picture  the facts of the picture, if the output is one
void report(const Options& options, OutputKind kind, std::span<const FieldGrid> grids, const ResultList& methods,
            const Result& picture, const Session& session) {
    Result result{
        {"wavelengths_m", wavelengths_of(grids)}, {"distance_m", options.plane.distance}, {"propagations", methods}};
    if (kind == OutputKind::hologram) return report_samples(session, options.output, result);
    const Grid& plane = grids.front().plane;
    if (kind == OutputKind::array)
        result.insert(result.end(), {{"samples_x", plane.width}, {"samples_y", plane.height}});
    result.insert(result.end(), {{"pitch_x_m", plane.pitch_x}, {"pitch_y_m", plane.pitch_y}});
    result.insert(result.end(), picture.begin(), picture.end());
    report_file(session, options.output, result);
}

// Prints the fraction of light within each output if any loses more than 1 %.
void report_shares(std::span<const FieldGrid> inputs, std::span<const std::optional<double>> shares,
                   const Session& session) {
    constexpr double min_share = 0.99;
    std::string lost;
    for (std::size_t c = 0; c < shares.size(); ++c)
        if (shares[c] && *shares[c] < min_share)
            lost += fmt::format("{}{:.3g} % of the light of {}", lost.empty() ? "" : ", ", 100 * *shares[c],
                                format_length(inputs[c].wavelength));
    if (lost.empty()) return;
    const Grid& plane = inputs.front().plane;
    const char* const spreads = plane.height == 1  ? "; the light of a single row spreads vertically"
                                : plane.width == 1 ? "; the light of a single column spreads horizontally"
                                                   : "";
    session.say(fmt::format("the output contains {}; the rest falls outside (--output-samples, --output-pitch){}", lost,
                            spreads));
}

// Returns the propagation method of each wavelength for --json; prints it with -v.
std::vector<Result> methods_of(const Fields& fields, const Options& options,
                               const std::vector<PropagateOptions>& propagations, const Session& session) {
    std::vector<Result> methods;
    for (std::size_t c = 0; c < fields.size(); ++c) {
        const FieldGrid& grid = fields[c]->grid();
        const PropagationMethod method = propagation_method(grid, options.plane.distance, propagations[c]);
        session.detail(
            fmt::format("{}: by {}, Fresnel number {:.3g}, {}x{} frequencies, {}x{} tiles, predicted error {:.1e}",
                        format_length(grid.wavelength), method.name, method.fresnel_number, method.frequencies_x,
                        method.frequencies_y, method.tiles_x, method.tiles_y, method.error));
        methods.emplace_back(Result{{"wavelength_m", grid.wavelength},
                                    {"method", std::string(method.name)},
                                    {"fresnel_number", method.fresnel_number},
                                    {"predicted_error", method.error},
                                    {"frequencies_x", method.frequencies_x},
                                    {"frequencies_y", method.frequencies_y},
                                    {"tiles", method.tiles_x * method.tiles_y}});
    }
    return methods;
}

int propagate_fields(Options& options, const Session& session) {
    const OutputKind kind = output_kind(options.output, options.plane.display);
    require_writable(options.output, {&options.input, 1});
    if (options.resume && kind != OutputKind::hologram)
        throw Error(ErrorCode::usage, "resume", fmt::format("only .h5 outputs can be resumed, not {}", options.output));
    options.plane.is_picture = kind == OutputKind::picture || options.plane.display == "field";
    const Fields fields = open_and_reconstruct(session, options.input, options.field);
    if (kind == OutputKind::picture && options.plane.display == "phase") require_one_wavelength(fields);
    if (kind == OutputKind::picture && fields.size() != 1 && fields.size() != 3)
        throw Error(ErrorCode::bad_input,
                    fmt::format("{}: has {} wavelengths; a picture takes one or three", options.input, fields.size()));
    // Scratch files go to the output's folder.
    const ScratchOptions scratch{ScratchOptions().memory, std::filesystem::absolute(options.output).parent_path()};
    Result picture_result;
    std::vector<FieldGrid> inputs, grids;
    std::vector<PropagateOptions> propagations;
    for (const auto& field : fields) {
        inputs.push_back(field->grid());
        propagations.push_back(options.plane.options(field->grid().plane));
        propagations.back().scratch = scratch;
        grids.push_back({*propagations.back().output, field->grid().wavelength});
    }
    std::vector<Result> methods = with_renamed_parameters(
        {{"pitch", "output_pitch"}}, [&] { return methods_of(fields, options, propagations, session); });
    check_plan(session, plan_propagation(inputs, options.plane.distance, propagations.front()), "propagation",
               options.output);
    Stage stage(session, "propagation");
    std::vector<std::optional<double>> shares(grids.size());
    const auto colour = [&](std::size_t c, FieldSink& sink) {
        shares[c] = propagate_measured(*fields[c], options.plane.distance, sink, propagations[c],
                                       stage.progress(c, grids.size()));
        if (shares[c]) methods[c].emplace_back("light_share", *shares[c]);
    };
    const Grid& plane = grids.front().plane;
    options.plane.resolve(plane);
    Metadata metadata = with_history(run_metadata(session), to_metadata(fields.front()->provenance()));
    if (kind == OutputKind::hologram) {
        HologramFileOptions file{.metadata = metadata};
        if (options.resume) file.resume = describe_input(options.input);
        const auto sinks = create_hologram(options.output, grids, file);
        for (std::size_t c = 0; c < grids.size(); ++c) colour(c, *sinks[c]);
    } else if (kind == OutputKind::array) {
        std::vector<Field> propagated;
        for (std::size_t c = 0; c < grids.size(); ++c) colour(c, propagated.emplace_back(grids[c]));
        if (is_root_rank()) write_fields(options.output, propagated, metadata);
    } else {
        Image picture(plane.width, plane.height, grids.size());
        for (std::size_t c = 0; c < grids.size(); ++c) {
            Field field(grids[c]);
            colour(c, field);
            const Image channel = picture_of(field.samples, quantity_of(options.plane.display));
            for (std::size_t i = 0; i < channel.pixels.size(); ++i)
                picture.pixels.data()[i * grids.size() + c] = channel.pixels.data()[i];
        }
        if (options.plane.display == "log") picture = logarithmic(picture);
        const bool grey = options.plane.display == "log" || options.plane.display == "phase";
        const double exposure = grey ? 1 : automatic_exposure(picture);
        metadata.emplace_back("exposure", fmt::format("{:.9g}", exposure));
        picture_result = {{"width", picture.width()}, {"height", picture.height()}, {"exposure", exposure}};
        if (is_root_rank()) write_image(options.output, picture, exposure, metadata);
    }
    if (!is_root_rank()) return 0;
    session.say(fmt::format("{}: {}x{} samples at {}, {} on", options.output, plane.width, plane.height,
                            format_length(plane.pitch_x), format_length(options.plane.distance)));
    report_shares(inputs, shares, session);
    report(options, kind, grids, {methods.begin(), methods.end()}, picture_result, session);
    return 0;
}

}  // namespace

void add_propagate(Command& command, Session& session) {
    auto options = std::make_shared<Options>();
    command.examples(
        "  hogel propagate hologram.h5 -o face.png --distance -4mm\n"
        "  hogel propagate hologram.h5 -o nearer.h5 --distance 20mm\n"
        "  hogel propagate hologram.h5 -o eye.png --distance 300mm --output-pitch 20um --output-samples 512\n"
        "  hogel propagate slm.npy -o there.npy --distance 0.2m --pitch 8um --wavelength 532nm");
    command.basics({"display", "output-pitch", "output-samples", "pitch", "wavelength", "values", "phase-code", "order",
                    "reconstruct", "focal"});
    command.positional("input", options->input, "F.h5|F.npy|P.png", "Hologram, or another program's field");
    command
        .text("-o,--output", options->output, "FILE",
              "Hologram (.h5), array (.npy, .npz, .mat) or picture (.png, .exr)")
        .required()
        .never_acts();
    options->plane.declare(command);
    options->field.declare(command);
    options->field.declare_reconstruction(command);
    add_resume_flag(command, options->resume);
    command.add_like_option();
    command.work([options, &session] { return propagate_fields(*options, session); });
}

}  // namespace hogel::cli
