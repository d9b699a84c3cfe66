// SPDX-License-Identifier: Apache-2.0
// A light field as an array of a MAT file of version 5 or 7.3. The Light Field Toolbox (doda42/LFToolbox) uses
// LF(t,s,v,u,c): row and column of views, y, x, channel; a fourth channel is a weight. Other programs put the picture
// axes first, or the channel third: decided by the extents. The parallax decides which view axis is the column.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <variant>

#include "hogel/core/lower_case.h"
#include "hogel/core/output_file.h"
#include "hogel/core/raw_file.h"
#include "hogel/error.h"
#include "hogel/exchange/view_order.h"
#include "hogel/io/arrays/mat.h"
#include "hogel/io/arrays/mat_write.h"
#include "hogel/work/parallel.h"

namespace hogel::exchange {
namespace fs = std::filesystem;
namespace {

using io::arrays::Number;
using io::arrays::NumberArray;

std::vector<NumberArray> light_fields_in(const fs::path& source) {
    std::vector<NumberArray> arrays = io::arrays::mat_heads(source);
    std::erase_if(arrays, [](const NumberArray& array) { return array.shape.size() < 4 || array.shape.size() > 5; });
    return arrays;
}

bool probe(const fs::path& source) {
    const std::string ending = core::lower_case_extension(source);
    std::error_code none;
    if (ending != ".mat" || !fs::is_regular_file(source, none)) return false;
    try {
        return !light_fields_in(source).empty();
    } catch (const Error& error) {
        if (error.code() == ErrorCode::not_built_in) throw;
        return false;
    }
}

// Meaning of the axes of an array; `channel` is shape.size() if there is none.
struct Axes {
    std::size_t row = 0, column = 1, y = 2, x = 3, channel = 4;

    // In MATLAB's notation: "(row of views, column of views, y, x, channel)".
    std::string text() const {
        std::array<const char*, 5> names{};
        names[row] = "row of views", names[column] = "column of views", names[y] = "y", names[x] = "x";
        if (channel < names.size()) names[channel] = "channel";
        std::vector<const char*> used;
        for (const char* name : names)
            if (name != nullptr) used.push_back(name);
        return fmt::format("({})", fmt::join(used, ", "));
    }
};

// Returns the axis of 3 channels (last or third), 4 (last), 1 (last or third) or 3 (first); else shape.size().
std::size_t channel_axis(const std::vector<std::size_t>& shape) {
    constexpr std::pair<std::size_t, std::size_t> by_rank[] = {{4, 3}, {2, 3}, {4, 4}, {4, 1}, {2, 1}, {0, 3}};
    for (const auto& [axis, elements] : by_rank)
        if (shape.size() == 5 && shape[axis] == elements) return axis;
    return shape.size();
}

// Takes as view axes the pair of non-channel axes with fewer elements.
Axes axes_of(const fs::path& source, const NumberArray& array) {
    const std::vector<std::size_t>& shape = array.shape;
    Axes axes;
    axes.channel = channel_axis(shape);
    if (shape.size() == 5 && axes.channel == 5)
        fail_source(source, fmt::format("no axis of its array '{}' of {} numbers is one of 1, 3 or 4 channels",
                                        array.name, fmt::join(shape, "x")));
    std::vector<std::size_t> others;
    for (std::size_t axis = 0; axis < shape.size(); ++axis)
        if (axis != axes.channel) others.push_back(axis);
    const bool views_first = shape[others[0]] * shape[others[1]] <= shape[others[2]] * shape[others[3]];
    if (!views_first) std::rotate(others.begin(), others.begin() + 2, others.end());
    axes.row = others[0], axes.column = others[1], axes.y = others[2], axes.x = others[3];
    return axes;
}

// Array in view order, [row][column][y][x][channel]. In the file, neighbouring elements belong to neighbouring views.
class MatPictures final : public ViewPictures {
  public:
    MatPictures(const fs::path& source, const NumberArray& head) : source_(source) {
        const NumberArray array = io::arrays::read_mat_array(source, head.name);
        if (!array.imaginary.empty()) fail_source(source, fmt::format("its array '{}' is complex", array.name));
        const Axes axes = axes_of(source, array);
        const bool has_channels = axes.channel < array.shape.size();
        const std::size_t stored = has_channels ? array.shape[axes.channel] : 1, channels = stored == 4 ? 3 : stored;
        shape_ = {array.shape[axes.row], array.shape[axes.column], array.shape[axes.y], array.shape[axes.x], channels};
        if (shape_[2] > max_pixels / shape_[3]) fail_source(source, "its views have too many pixels");
        notes_.push_back(fmt::format("the axes of {} were taken for {}", array.name, axes.text()));
        if (stored == 4) notes_.emplace_back("the fourth channel was taken for a weight, and left out");
        choose_codes(array);
        std::vector<std::size_t> steps(array.shape.size());
        steps[axes.row] = shape_[1] * view_samples();
        steps[axes.column] = view_samples();
        steps[axes.y] = shape_[3] * channels;
        steps[axes.x] = channels;
        if (has_channels) steps[axes.channel] = 1;
        if (max_code_ == 0)
            numbers_ = in_order<float>(array, axes.channel, steps, [](double value) {
                return std::abs(value) <= std::numeric_limits<float>::max() ? static_cast<float>(value) : NAN;
            });
        else if (max_code_ == 255)
            numbers_ = in_order<std::uint8_t>(array, axes.channel, steps,
                                              [](double value) { return static_cast<std::uint8_t>(value); });
        else
            numbers_ = in_order<std::uint16_t>(array, axes.channel, steps, [max = max_code_](double value) {
                return static_cast<std::uint16_t>((static_cast<std::uint32_t>(value) * 65535 + max / 2) / max);
            });
    }

    std::size_t rows() const { return shape_[0]; }
    std::size_t columns() const { return shape_[1]; }
    const std::vector<std::string>& notes() const { return notes_; }

    image::Picture read(std::size_t row, std::size_t column) const override {
        return std::visit(
            [&](const auto& numbers) {
                using T = typename std::remove_cvref_t<decltype(numbers)>::value_type;
                Array<T, 3> view({shape_[2], shape_[3], shape_[4]});
                std::copy_n(numbers.data() + (row * columns() + column) * view_samples(), view_samples(), view.data());
                return image::Picture{std::move(view), {}, max_code_ == 1023 || max_code_ == 4095 ? max_code_ : 0};
            },
            numbers_);
    }
    std::string name(std::size_t row, std::size_t column) const override {
        return fmt::format("{}, view ({}, {})", source_.string(), row + 1, column + 1);
    }

  private:
    std::size_t view_samples() const { return shape_[2] * shape_[3] * shape_[4]; }

    // Chooses the largest code: by the integer class, 10 or 12 bits by the maximum; integral floats are codes.
    void choose_codes(const NumberArray& array) {
        double least = 0, largest = 0;
        bool all_whole = true;
        for (std::size_t i = 0; i < array.samples(); ++i) {
            const double value = array.real_at(i);
            largest = std::max(largest, value);
            least = std::min(least, value);
            all_whole = all_whole && value == std::floor(value);
        }
        const bool whole_codes = all_whole && least == 0;
        if (array.floating)
            max_code_ = whole_codes && largest > 1 && largest <= 255 ? 255 : 0;
        else if (array.number_class == Number::uint8)
            max_code_ = 255;
        else if (array.number_class == Number::uint16)
            max_code_ = largest > 1023 && largest <= 4095 ? 4095 : largest > 255 && largest <= 1023 ? 1023 : 65535;
        else
            fail_source(
                source_,
                fmt::format("its array '{}' holds numbers of another class than uint8, uint16, single and double",
                            array.name));
        if (max_code_ != 0 && (!whole_codes || largest > max_code_))
            fail_source(source_, fmt::format("its array '{}' is damaged", array.name));
        if (max_code_ == 1023 || max_code_ == 4095 || (array.floating && max_code_ != 0))
            notes_.push_back(fmt::format("by the largest of the numbers, {}, they were taken for codes up to {}",
                                         largest, max_code_));
    }

    // Returns the numbers at the offsets given by `steps` for each axis, without those of a weight channel.
    template <class T, class Convert>
    std::vector<T> in_order(const NumberArray& array, std::size_t channel_axis, const std::vector<std::size_t>& steps,
                            const Convert& convert) const {
        std::vector<T> to(shape_[0] * shape_[1] * view_samples());
        const std::size_t last = array.shape.size() - 1, slices = array.shape[last], slice = array.samples() / slices;
        work::parallel_for(slices, [&](std::size_t i) {
            std::vector<std::size_t> index(array.shape.size());
            index[last] = i;
            std::size_t offset = i * steps[last];
            for (std::size_t n = 0; n < slice; ++n) {
                if (channel_axis > last || index[channel_axis] < shape_[4])
                    to[offset] = convert(array.real_at(i * slice + n));
                for (std::size_t axis = 0; axis < last; ++axis) {
                    offset += steps[axis];
                    if (++index[axis] < array.shape[axis]) break;
                    offset -= array.shape[axis] * steps[axis];
                    index[axis] = 0;
                }
            }
        });
        return to;
    }

    fs::path source_;
    std::array<std::size_t, 5> shape_{};
    std::vector<std::string> notes_;
    std::uint32_t max_code_ = 0;  // 0: floating-point numbers
    std::variant<std::vector<std::uint8_t>, std::vector<std::uint16_t>, std::vector<float>> numbers_;
};

ViewSet open(const fs::path& source, const ViewImportOptions& options) {
    const std::vector<NumberArray> found = light_fields_in(source);
    if (found.empty()) fail_source(source, "has no array of four or five axes, such as LF(t,s,v,u,c)");
    const auto named = std::ranges::find(found, "LF", &NumberArray::name);
    const auto& head = named != found.end() ? *named : found.front();
    if (named == found.end() && found.size() > 1)
        fail_source(source, fmt::format("has {} arrays that could be a light field, {} and {} among them, and none is "
                                        "called LF",
                                        found.size(), found[0].name, found[1].name));
    const auto pictures = std::make_shared<MatPictures>(source, head);
    ViewSet set;
    set.rows = pictures->rows();
    set.columns = pictures->columns();
    set.pictures = pictures;
    set.notes = pictures->notes();
    take_size(*set.pictures->look(0, 0), set);
    set = ordered_by_parallax(std::move(set), options, "the first axis of views", "the second axis of views");
    set.geometry.orthographic = options.orthographic.value_or(false);
    return set;
}

// Holds the whole array, because neighbouring elements belong to neighbouring views.
class Writer final : public ViewWriter {
  public:
    explicit Writer(const ViewTarget& target) : target_(target), beginning_(target.path) {
        const std::vector<std::size_t> shape{target.rows, target.columns, target.height, target.width, target.channels};
        if (!target.texts.empty()) {
            std::string history;
            for (const auto& [key, text] : target.texts) history += fmt::format("{}: {}\n", key, text);
            beginning_.text("history", history);
        }
        const Number number = target.bits <= 8 ? Number::uint8 : target.bits <= 16 ? Number::uint16 : Number::single;
        beginning_.begin_numbers("LF", shape, number);
        const std::size_t count = target.rows * target.columns * target.height * target.width * target.channels;
        numbers_.resize((count * io::arrays::bytes_of(number) + 7) / 8 * 8);
    }

    fs::path write(std::size_t row, std::size_t column, const StoredView& view) override {
        std::visit(
            [&](const auto& samples) {
                using T = std::remove_cvref_t<decltype(samples(0, 0, 0))>;
                const std::size_t views = target_.rows * target_.columns;
                unsigned char* to = numbers_.data() + (column * target_.rows + row) * sizeof(T);
                for (std::size_t c = 0; c < target_.channels; ++c)
                    for (std::size_t x = 0; x < target_.width; ++x)
                        for (std::size_t y = 0; y < target_.height; ++y) {
                            std::memcpy(to, &samples(y, x, c), sizeof(T));
                            to += views * sizeof(T);
                        }
            },
            view);
        return {};
    }

    std::vector<fs::path> finish() override {
        core::OutputFile output(target_.path);
        core::RawFile file(output.temporary(), core::RawFile::Mode::create, target_.path);
        file.write(0, beginning_.bytes().data(), beginning_.bytes().size());
        file.write(beginning_.bytes().size(), numbers_.data(), numbers_.size());
        file.close();
        output.commit();
        return {target_.path};
    }

  private:
    ViewTarget target_;
    io::arrays::MatWriter beginning_;
    std::vector<unsigned char> numbers_;
};

}  // namespace

ViewLayout mat_layout() {
    return {.name = "mat",
            .text = "MATLAB array LF(row of views, column of views, y, x, channel), MAT file of version 5 or 7.3",
            .is_folder = false,
            .cameras_only = false,
            .has_pictures = false,
            .written_at_once = true,
            .probe = probe,
            .open = open,
            .create = [](const ViewTarget& target) -> std::unique_ptr<ViewWriter> {
                return std::make_unique<Writer>(target);
            }};
}

}  // namespace hogel::exchange
