// SPDX-License-Identifier: Apache-2.0
#include "hogel/io/arrays/named_arrays.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <initializer_list>
#include <string_view>

#include "hogel/error.h"

namespace hogel::io::arrays {
namespace {

using Words = std::span<const std::string_view>;
constexpr std::string_view real_words[] = {"real", "re", "r"}, imaginary_words[] = {"imaginary", "imag", "im", "i"},
                           amplitude_words[] = {"amplitude", "amp", "abs", "magnitude", "mag", "a"},
                           phase_words[] = {"phase", "phs", "angle", "arg", "p"};

std::string lower_case(std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text;
}

// What is left of a name without a word at its beginning or end: "holo" of "holo_re"; nothing if it has none.
std::optional<std::string> without(const std::string& name, Words words) {
    const std::string lower = lower_case(name);
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

bool name_parts(const std::string& first, Words first_words, const std::string& second, Words second_words) {
    const std::optional<std::string> a = without(first, first_words), b = without(second, second_words);
    return a && b && *a == *b;
}

// The arrays that hold a field.
struct Chosen {
    const NumberArray* first = nullptr;
    const NumberArray* second = nullptr;  // null where one array holds the field
    Content content = Content::real;
};

Chosen of_one(const NumberArray& array) {
    return {&array, nullptr, array.imaginary.empty() ? Content::real : Content::complex};
}

std::string names_of(const std::vector<const NumberArray*>& arrays) {
    std::string names;
    for (const NumberArray* array : arrays) names += fmt::format("{}{}", names.empty() ? "" : ", ", array->name);
    return names;
}

// Two real arrays of one shape, as their names say.
std::optional<Chosen> pair_of(const NumberArray& a, const NumberArray& b) {
    if (!a.imaginary.empty() || !b.imaginary.empty() || a.shape != b.shape) return std::nullopt;
    for (const auto& [first, second] : {std::pair(&a, &b), std::pair(&b, &a)}) {
        if (name_real_and_imaginary(first->name, second->name)) return Chosen{first, second, Content::complex};
        if (name_amplitude_and_phase(first->name, second->name)) return Chosen{first, second, Content::amplitude_phase};
    }
    return std::nullopt;
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
    if (!a.imaginary.empty() || !b.imaginary.empty() || a.shape != b.shape)
        fail_external(path, fmt::format("its arrays '{}' and '{}' are not two parts of one field", a.name, b.name));
    if (const std::optional<Chosen> pair = pair_of(a, b); pair && pair->first == &a) return *pair;
    return {&a, &b, Content::complex};
}

bool is_parameter(const NumberArray& array) { return array.samples() <= 3; }

Chosen chosen(const std::filesystem::path& path, const std::string& variable, const std::vector<NumberArray>& arrays) {
    if (!variable.empty()) return of_names(path, variable, arrays);
    std::vector<const NumberArray*> fields;
    for (const NumberArray& array : arrays)
        if (array.shape.size() >= 2 && !is_parameter(array)) fields.push_back(&array);
    // One field that is small, because nothing else could be meant.
    if (fields.empty())
        for (const NumberArray& array : arrays)
            if (array.shape.size() >= 2 && array.samples() > 1) fields.push_back(&array);
    if (fields.empty()) fail_external(path, "it holds no array of numbers with two axes");
    if (fields.size() == 1) return of_one(*fields.front());
    if (fields.size() == 2)
        if (const std::optional<Chosen> pair = pair_of(*fields[0], *fields[1])) return *pair;
    // One complex array among real ones, such as the picture that a hologram was made of.
    if (std::ranges::count_if(fields, [](const NumberArray* array) { return !array->imaginary.empty(); }) == 1)
        return of_one(**std::ranges::find_if(fields, [](const NumberArray* a) { return !a->imaginary.empty(); }));
    throw Error(ErrorCode::usage,
                fmt::format("'{}' holds several arrays; which one is meant of {}?", path.string(), names_of(fields)));
}

std::string kind_of(const Chosen& chosen) {
    // Whole numbers may stand for the doubles of MATLAB.
    const NumberArray& array = *chosen.first;
    const Number number = array.floating && is_whole(array.real_number) ? Number::real : array.real_number;
    const std::string width = is_whole(number)         ? fmt::format("whole numbers of {} bits", 8 * bytes_of(number))
                              : number == Number::real ? "double floats"
                              : number == Number::half ? "half floats"
                                                       : "single floats";
    return fmt::format("{}, {}",
                       chosen.content == Content::complex           ? "complex"
                       : chosen.content == Content::amplitude_phase ? "amplitudes and phases"
                                                                    : "real",
                       width);
}

}  // namespace

bool name_real_and_imaginary(const std::string& real, const std::string& imaginary) {
    return name_parts(real, real_words, imaginary, imaginary_words);
}

bool name_amplitude_and_phase(const std::string& amplitude, const std::string& phase) {
    return name_parts(amplitude, amplitude_words, phase, phase_words);
}

Planes planes_of(const std::filesystem::path& path, std::span<const std::size_t> shape, bool by_columns) {
    std::vector<std::size_t> steps(shape.size(), 1);
    for (std::size_t i = 1; i < shape.size(); ++i) {
        const std::size_t axis = by_columns ? i : shape.size() - 1 - i, faster = by_columns ? i - 1 : axis + 1;
        steps[axis] = steps[faster] * shape[faster];
    }
    std::size_t y = 0;
    Planes planes;
    const auto is_colours = [](std::size_t extent) { return extent == 1 || extent == 3; };
    const bool coloured = shape.size() == 3 && (is_colours(shape.front()) || is_colours(shape.back()));
    if (coloured) {
        // Where both may be: as MATLAB has colours, and as Python's programs for light do.
        const std::size_t axis = is_colours(by_columns ? shape.back() : shape.front()) == by_columns ? 2 : 0;
        y = axis == 0 ? 1 : 0;
        planes.colours = shape[axis];
        planes.step_colour = steps[axis];
    }
    if (shape.size() != 2 && !coloured)
        fail_external(path,
                      "an array of two axes, [row][column], or of three with three colours first or last was expected");
    planes.height = shape[y];
    planes.width = shape[y + 1];
    planes.step_y = steps[y];
    planes.step_x = steps[y + 1];
    return planes;
}

namespace {

// The unit at the end of a name, and its length in metres: "wav_um".
double take_unit(std::string& name) {
    constexpr std::pair<std::string_view, double> units[] = {{"_nm", 1e-9}, {"_um", 1e-6}, {"_mm", 1e-3}, {"_m", 1.0}};
    for (const auto& [ending, metres] : units)
        if (name.ends_with(ending)) {
            name.resize(name.size() - ending.size());
            return metres;
        }
    return 1;
}

bool is_one_of(const std::string& name, std::initializer_list<std::string_view> names) {
    return std::ranges::find(names, name) != names.end();
}

void complain(ExternalFacts& facts, const std::string& name, double value, const char* what) {
    if (facts.complaint.empty())
        facts.complaint = fmt::format("its variable '{}' is {:.9g}, which is no {} in metres", name, value, what);
}

}  // namespace

void take_parameter(const std::string& full, std::span<const double> values, ExternalFacts& facts) {
    std::string name = lower_case(full);
    const double unit = take_unit(name);
    std::erase(name, '_');
    // A length in metres that no unit in the name explains otherwise; others are named, not guessed at.
    constexpr double shortest_wave = 10e-9, longest_wave = 1e-3, shortest_pitch = 1e-9, longest_pitch = 0.1;
    const auto take = [&](double low, double high, const char* what) {
        std::vector<double> lengths;
        for (const double value : values) {
            if (!(value * unit >= low && value * unit <= high)) {
                complain(facts, full, value, what);
                return std::vector<double>{};
            }
            lengths.push_back(value * unit);
        }
        return lengths;
    };
    if (values.empty()) return;
    if (is_one_of(name,
                  {"wavelength", "wavelengths", "lambda", "lambdas", "wlen", "wav", "wl", "wvl", "wave", "lam"})) {
        if (facts.wavelengths.empty()) facts.wavelengths = take(shortest_wave, longest_wave, "wavelength");
        return;
    }
    const bool both =
        is_one_of(name, {"pitch", "pixelpitch", "pp", "pixelsize", "samplepitch", "featuresize", "slmpitch"});
    const bool across = is_one_of(name, {"dx", "pitchx", "pixelpitchx", "ppx"}),
               down = is_one_of(name, {"dy", "pitchy", "pixelpitchy", "ppy"});
    if ((!both && !across && !down) || values.size() > 2) return;
    const std::vector<double> pitches = take(shortest_pitch, longest_pitch, "pitch");
    if (pitches.empty()) return;
    if (pitches.size() == 2 && pitches[0] != pitches[1]) {
        facts.complaint =
            fmt::format("its variable '{}' holds two pitches, and does not say which is that of columns", full);
        return;
    }
    if (both || across) facts.pitch_x = pitches[0];
    if (both || down) facts.pitch_y = pitches[0];
}

ExternalFacts facts_of_arrays(const std::filesystem::path& path, const ExternalField& what,
                              const std::vector<NumberArray>& arrays, const std::string& format) {
    ExternalFacts facts;
    const Chosen field = chosen(path, what.variable, arrays);
    const Planes planes = planes_of(path, field.first->shape, field.first->by_columns);
    facts.format = format;
    facts.numbers = kind_of(field);
    facts.width = planes.width;
    facts.height = planes.height;
    facts.colours = planes.colours;
    for (const NumberArray& array : arrays) {
        if (&array == field.first || &array == field.second || !is_parameter(array) || !array.imaginary.empty())
            continue;
        std::vector<double> values;
        for (std::size_t i = 0; i < array.samples(); ++i) values.push_back(array.real_at(i));
        take_parameter(array.name, values, facts);
    }
    if (facts.pitch_y == 0) facts.pitch_y = facts.pitch_x;  // dx alone
    if (facts.pitch_x == 0) facts.pitch_x = facts.pitch_y;
    if (!facts.wavelengths.empty() && facts.wavelengths.size() != facts.colours) {
        facts.complaint = fmt::format("it holds {} wavelengths for {} {}", facts.wavelengths.size(), facts.colours,
                                      facts.colours == 1 ? "field" : "fields");
        facts.wavelengths.clear();
    }
    return facts;
}

std::unique_ptr<FieldSource> open_arrays(const std::filesystem::path& path, const ExternalField& what,
                                         const std::vector<NumberArray>& arrays) {
    const Chosen parts = chosen(path, what.variable, arrays);
    const NumberArray &first = *parts.first, &second = parts.second ? *parts.second : first;
    const SampleConverter convert(path, what, parts.content, first.kind(),
                                  parts.second ? second.kind() : first.imaginary_number);
    auto field = std::make_unique<Field>(external_grid(path, what, facts_of_arrays(path, what, arrays, "")));
    const Planes a = planes_of(path, first.shape, first.by_columns),
                 b = planes_of(path, second.shape, second.by_columns);
    const auto other_at = [&](std::size_t i) {
        return parts.second ? second.real_at(i) : first.imaginary.empty() ? 0 : first.imaginary_at(i);
    };
    for (std::size_t y = 0; y < a.height; ++y)
        for (std::size_t x = 0; x < a.width; ++x)
            field->samples(y, x) = convert(first.real_at(y * a.step_y + x * a.step_x + what.colour * a.step_colour),
                                           other_at(y * b.step_y + x * b.step_x + what.colour * b.step_colour));
    return field;
}

}  // namespace hogel::io::arrays
