// SPDX-License-Identifier: Apache-2.0
#include "hogel/io/arrays/named_arrays.h"
#include "hogel/core/stop_scope.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>

#include "hogel/core/lower_case.h"
#include "hogel/error.h"

namespace hogel::io::arrays {
namespace {

using Words = std::span<const std::string_view>;
constexpr std::string_view real_words[] = {"real", "re", "r"}, imaginary_words[] = {"imaginary", "imag", "im", "i"},
                           amplitude_words[] = {"amplitude", "amp", "abs", "magnitude", "mag", "a"},
                           phase_words[] = {"phase", "phs", "angle", "arg", "p"};

// Removes a word and its separator from the beginning or end of a name ("holo_re" -> "holo"); nothing if it has none.
std::optional<std::string> without(const std::string& name, Words words) {
    const std::string lower = core::lower_case(name);
    for (const std::string_view word : words) {
        if (lower == word) return "";
        if (lower.size() <= word.size() + 1) continue;
        const std::size_t rest = lower.size() - word.size();
        const auto separates = [](char c) { return c == '_' || c == '.' || c == '-'; };
        if (lower.ends_with(word) && separates(lower[rest - 1])) return lower.substr(0, rest - 1);
        if (lower.starts_with(word) && separates(lower[word.size()])) return lower.substr(word.size() + 1);
    }
    return std::nullopt;
}

struct Chosen {
    const NumberArray* first = nullptr;
    const NumberArray* second = nullptr;  // null if one array holds the field
    Content content = Content::real;
};

Chosen of_one(const NumberArray& array) { return {&array, nullptr, array.complex ? Content::complex : Content::real}; }

std::string names_of(const std::vector<const NumberArray*>& arrays) {
    std::string names;
    for (const NumberArray* array : arrays) names += fmt::format("{}{}", names.empty() ? "" : ", ", array->name);
    return names;
}

// Returns the pair of real arrays of equal shape whose names denote parts of a field, if there is exactly one.
std::optional<Chosen> only_pair_of(const std::vector<const NumberArray*>& arrays) {
    std::vector<const NumberArray*> real;
    std::vector<PartName> names;
    for (const NumberArray* array : arrays)
        if (!array->complex) {
            real.push_back(array);
            names.push_back({array->name, fmt::format("{}", fmt::join(array->shape, "x"))});
        }
    const std::vector<PartPair> pairs = pairs_of_parts(names, 2);
    if (pairs.size() != 1) return std::nullopt;
    return Chosen{real[pairs[0].first], real[pairs[0].second], pairs[0].content};
}

Chosen of_names(const std::filesystem::path& path, const std::string& variable,
                const std::vector<NumberArray>& arrays) {
    const auto named = [&](const std::string& name) -> const NumberArray& {
        const auto found = std::ranges::find(arrays, name, &NumberArray::name);
        if (found == arrays.end())
            fail_external(path, fmt::format("it holds no array '{}' of numbers with two axes", name));
        return *found;
    };
    const std::size_t comma = variable.find(',');
    if (comma == std::string::npos) return of_one(named(variable));
    const NumberArray &a = named(variable.substr(0, comma)), &b = named(variable.substr(comma + 1));
    if (a.complex || b.complex || a.shape != b.shape)
        fail_external(path, fmt::format("its arrays '{}' and '{}' are not two parts of one field", a.name, b.name));
    if (const std::optional<Chosen> pair = only_pair_of({&a, &b}); pair && pair->first == &a) return *pair;
    return {&a, &b, Content::complex};
}

bool is_parameter(const NumberArray& array) { return array.samples() <= 3; }

Chosen chosen(const std::filesystem::path& path, const std::string& variable, const std::vector<NumberArray>& arrays) {
    if (!variable.empty()) return of_names(path, variable, arrays);
    std::vector<const NumberArray*> fields;
    for (const NumberArray& array : arrays)
        if (array.shape.size() >= 2 && !is_parameter(array)) fields.push_back(&array);
    // Accept a small field if there is no other candidate.
    if (fields.empty())
        for (const NumberArray& array : arrays)
            if (array.shape.size() >= 2 && array.samples() > 1) fields.push_back(&array);
    if (fields.empty()) fail_external(path, "it holds no array of numbers with two axes");
    if (fields.size() == 1) return of_one(*fields.front());
    if (const std::optional<Chosen> pair = only_pair_of(fields)) return *pair;
    // A complex array takes precedence over real ones, such as the source picture of a hologram.
    if (std::ranges::count_if(fields, [](const NumberArray* array) { return array->complex; }) == 1)
        return of_one(**std::ranges::find_if(fields, [](const NumberArray* a) { return a->complex; }));
    throw Error(ErrorCode::usage, "variable",
                fmt::format("'{}' holds several arrays; which one is meant of {}?", path.string(), names_of(fields)));
}

Planes planes_of_array(const std::filesystem::path& path, const NumberArray& array, const Chosen& chosen) {
    // In a pair of arrays, no axis holds the parts of samples.
    return arrays::planes_of(path, array.shape, array.by_columns, chosen.content != Content::real);
}

std::string kind_of(const Chosen& chosen, bool pairs) {
    // Integers may represent MATLAB doubles.
    const NumberArray& array = *chosen.first;
    const Number number = array.floating && is_whole(array.real_number) ? Number::real : array.real_number;
    const std::string width = is_whole(number)         ? fmt::format("whole numbers of {} bits", 8 * bytes_of(number))
                              : number == Number::real ? "double floats"
                              : number == Number::half ? "half floats"
                                                       : "single floats";
    return fmt::format("{}, {}",
                       chosen.content == Content::complex           ? "complex"
                       : chosen.content == Content::amplitude_phase ? "amplitudes and phases"
                       : pairs                                      ? "pairs of real numbers"
                                                                    : "real",
                       width);
}

}  // namespace

std::vector<PartPair> pairs_of_parts(std::span<const PartName> names, std::size_t most) {
    struct Kind {
        Content content;
        Words first, second;
    };
    const Kind kinds[] = {{Content::complex, real_words, imaginary_words},
                          {Content::amplitude_phase, amplitude_words, phase_words}};
    std::vector<PartPair> pairs;
    for (const Kind& kind : kinds) {
        std::map<std::pair<std::string, std::string>, std::vector<std::size_t>> firsts;  // by remaining name and group
        for (std::size_t i = 0; i < names.size(); ++i)
            if (auto rest = without(names[i].name, kind.first)) firsts[{std::move(*rest), names[i].group}].push_back(i);
        for (std::size_t k = 0; k < names.size(); ++k) {
            auto rest = without(names[k].name, kind.second);
            if (!rest) continue;
            const auto found = firsts.find({std::move(*rest), names[k].group});
            if (found == firsts.end()) continue;
            for (const std::size_t i : found->second) {
                if (i == k) continue;
                if (pairs.size() == most) return pairs;
                pairs.push_back({i, k, kind.content});
            }
        }
    }
    return pairs;
}

Planes planes_of(const std::filesystem::path& path, std::span<const std::size_t> shape, bool by_columns, bool complex) {
    struct Axis {
        std::size_t extent, step;
    };
    std::vector<Axis> axes(shape.size());
    for (std::size_t i = 0, step = 1; i < shape.size(); ++i) {
        const std::size_t axis = by_columns ? i : shape.size() - 1 - i;
        axes[axis] = {shape[axis], step};
        step *= shape[axis];
    }
    // Removes the first or last axis if it matches; `last` decides if both match.
    const auto take = [&](bool last, const auto& matches) {
        if (axes.size() <= 2 || !(matches(axes.front().extent) || matches(axes.back().extent))) return Axis{};
        const bool back = last ? matches(axes.back().extent) : !matches(axes.front().extent);
        const Axis taken = back ? axes.back() : axes.front();
        axes.erase(back ? axes.end() - 1 : axes.begin());
        return taken;
    };
    while (take(by_columns, [](std::size_t n) { return n == 1; }).extent > 0) continue;
    Planes planes;
    const auto is_colours = [&](std::size_t n) { return n == 3 || (n == 2 && complex); };
    const auto take_colours = [&] {
        // By the conventions of MATLAB and of Python optics packages.
        if (const Axis colours = take(by_columns, is_colours); colours.extent > 0) {
            planes.colours = colours.extent;
            planes.step_colour = colours.step;
        }
    };
    if (axes.size() == 3) take_colours();
    if (!complex) planes.step_pair = take(true, [](std::size_t n) { return n == 2; }).step;
    take_colours();
    if (axes.size() != 2)
        fail_external(path, fmt::format("an array of rows and columns was expected, which three colours or the two "
                                        "parts of samples may precede or follow, not one of {}",
                                        fmt::join(shape, "x")));
    planes.height = axes[0].extent;
    planes.width = axes[1].extent;
    planes.step_y = axes[0].step;
    planes.step_x = axes[1].step;
    return planes;
}

namespace {

enum class Parameter { none, wavelength, pitch, across, down };

// Classifies a lower-case name without underscores.
Parameter parameter_named(std::string_view name) {
    constexpr std::string_view
        waves[] = {"wavelength", "wavelengths", "wavelen", "lambda", "lambdas", "lambda0",
                   "wlen",       "wav",         "wl",      "wvl",    "wave",    "lam"},
        pitches[] = {"pitch",         "pixelpitch",    "pp",          "pixelsize", "pixelspacing", "samplepitch",
                     "samplespacing", "samplingpitch", "featuresize", "slmpitch",  "dxy"},
        across[] = {"dx", "deltax", "pitchx", "pixelpitchx", "pixelsizex", "ppx"},
        down[] = {"dy", "deltay", "pitchy", "pixelpitchy", "pixelsizey", "ppy"};
    const auto is_of = [&](Words words) { return std::ranges::find(words, name) != words.end(); };
    return is_of(waves)     ? Parameter::wavelength
           : is_of(pitches) ? Parameter::pitch
           : is_of(across)  ? Parameter::across
           : is_of(down)    ? Parameter::down
                            : Parameter::none;
}

// As parameter_named(), for names that may end in a unit: "wav_um". `unit` receives its length in metres.
Parameter parameter_of(const std::string& full, double& unit) {
    std::string name = core::lower_case(full);
    std::erase(name, '_');
    unit = 1;
    if (const Parameter parameter = parameter_named(name); parameter != Parameter::none) return parameter;
    constexpr std::pair<std::string_view, double> units[] = {{"nm", 1e-9}, {"um", 1e-6}, {"mm", 1e-3}, {"m", 1.0}};
    for (const auto& [ending, metres] : units)
        if (name.ends_with(ending)) {
            unit = metres;
            return parameter_named(std::string_view(name).substr(0, name.size() - ending.size()));
        }
    return Parameter::none;
}

void complain(ExternalFacts& facts, const std::string& name, double value, const char* quantity) {
    if (facts.complaint.empty())
        facts.complaint = fmt::format("its variable '{}' is {:.9g}, which is no {} in metres", name, value, quantity);
}

}  // namespace

void take_parameter(const std::string& full, std::span<const double> values, ExternalFacts& facts) {
    double unit = 1;
    const Parameter parameter = parameter_of(full, unit);
    if (parameter == Parameter::none || values.empty()) return;
    // Plausible lengths in metres. Others are reported, not guessed: millimetres would be plausible too.
    constexpr double shortest_wave = 10e-9, longest_wave = 20e-6, shortest_pitch = 1e-9, longest_pitch = 0.99e-3;
    const auto take = [&](double low, double high, const char* quantity) {
        std::vector<double> lengths;
        for (const double value : values) {
            if (!(value * unit >= low && value * unit <= high)) {
                complain(facts, full, value, quantity);
                return std::vector<double>{};
            }
            lengths.push_back(value * unit);
        }
        return lengths;
    };
    if (parameter == Parameter::wavelength) {
        if (facts.wavelengths.empty()) facts.wavelengths = take(shortest_wave, longest_wave, "wavelength");
        return;
    }
    if (values.size() > 2) return;
    const std::vector<double> pitches = take(shortest_pitch, longest_pitch, "pitch");
    if (pitches.empty()) return;
    if (pitches.size() == 2 && pitches[0] != pitches[1]) {
        facts.complaint =
            fmt::format("its variable '{}' holds two pitches, and does not say which is that of columns", full);
        return;
    }
    if (parameter != Parameter::down) facts.pitch_x = pitches[0];
    if (parameter != Parameter::across) facts.pitch_y = pitches[0];
}

ExternalFacts facts_of_arrays(const std::filesystem::path& path, const ExternalField& description,
                              const std::vector<NumberArray>& arrays, const std::string& format) {
    ExternalFacts facts;
    const Chosen field = chosen(path, description.variable, arrays);
    const Planes planes = planes_of_array(path, *field.first, field);
    facts.format = format;
    facts.numbers = kind_of(field, planes.step_pair > 0);
    facts.width = planes.width;
    facts.height = planes.height;
    facts.colours = planes.colours;
    for (const NumberArray& array : arrays) {
        if (&array == field.first || &array == field.second || !is_parameter(array) || array.complex) continue;
        std::vector<double> values;
        for (std::size_t i = 0; i < array.samples(); ++i) values.push_back(array.real_at(i));
        take_parameter(array.name, values, facts);
    }
    if (facts.pitch_y == 0) facts.pitch_y = facts.pitch_x;  // only dx is given
    if (facts.pitch_x == 0) facts.pitch_x = facts.pitch_y;
    if (!facts.wavelengths.empty() && facts.wavelengths.size() != facts.colours) {
        facts.complaint = fmt::format("it holds {} wavelengths for {} {}", facts.wavelengths.size(), facts.colours,
                                      facts.colours == 1 ? "field" : "fields");
        facts.wavelengths.clear();
    }
    return facts;
}

std::unique_ptr<FieldSource> open_arrays(const std::filesystem::path& path, const ExternalField& description,
                                         const std::vector<NumberArray>& arrays) {
    const Chosen parts = chosen(path, description.variable, arrays);
    const NumberArray &first = *parts.first, &second = parts.second ? *parts.second : first;
    const Planes a = planes_of_array(path, first, parts), b = planes_of_array(path, second, parts);
    ExternalField resolved = description;
    const Content content = a.step_pair > 0 ? take_pairs(path, resolved) : parts.content;
    const SampleConverter convert(path, resolved, content, first.kind(),
                                  parts.second || a.step_pair > 0 ? second.kind() : first.imaginary_number);
    auto field =
        std::make_unique<Field>(external_grid(path, description, facts_of_arrays(path, description, arrays, "")));
    const auto second_at = [&](std::size_t i) {
        if (parts.second || a.step_pair > 0) return second.real_at(i + a.step_pair);
        return first.imaginary.empty() ? 0 : first.imaginary_at(i);
    };
    for (std::size_t y = 0; y < a.height; ++y) {
        core::throw_if_stopped();
        for (std::size_t x = 0; x < a.width; ++x)
            field->samples(y, x) =
                convert(first.real_at(y * a.step_y + x * a.step_x + description.colour * a.step_colour),
                        second_at(y * b.step_y + x * b.step_x + description.colour * b.step_colour));
    }
    require_finite(*field, description.colour, path);
    return field;
}

}  // namespace hogel::io::arrays
