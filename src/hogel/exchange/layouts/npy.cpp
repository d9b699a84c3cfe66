// SPDX-License-Identifier: Apache-2.0
// A NumPy array [row of views][column of views][y][x][channel] of uint8, uint16 or float32, without geometry. views[0,
// 0] belongs to the camera at the top left. Without the last axis there is one channel.
#include <fmt/format.h>

#include <algorithm>

#include "hogel/core/output_file.h"
#include "hogel/error.h"
#include "hogel/exchange/view_set.h"
#include "hogel/io/arrays/npy.h"

namespace hogel::exchange {
namespace fs = std::filesystem;
namespace {

using io::arrays::NpyHeader;
using io::arrays::Number;

/// Removes leading batch axes of extent 1 beyond the five axes of views.
std::vector<std::size_t> without_batches(std::vector<std::size_t> shape) {
    while (shape.size() > 5 && shape.front() == 1) shape.erase(shape.begin());
    return shape;
}

/// Returns whether an array is a complex field: axes of 1 before colours, or real and imaginary parts.
bool is_field(const NpyHeader& header, const std::vector<std::size_t>& shape) {
    if (header.complex) return true;
    if (shape.size() == 4) return shape[0] == 1 && (shape[1] <= 3 || shape[3] <= 3);
    return shape.size() == 5 && shape[0] == 1 && shape[1] == 1 && shape[4] != 1 && shape[4] != 3;
}

bool probe(const fs::path& source) {
    std::error_code none;
    if (source.extension() != ".npy" || !fs::is_regular_file(source, none)) return false;
    try {
        const core::RawFile file(source, core::RawFile::Mode::read, source);
        const NpyHeader header = io::arrays::read_npy_header(source, file);
        const std::vector<std::size_t> shape = without_batches(header.shape);
        return shape.size() >= 4 && !is_field(header, shape);
    } catch (const Error&) {
        return false;
    }
}

class NpyPictures final : public ViewPictures {
  public:
    explicit NpyPictures(const fs::path& source)
        : file_(source, core::RawFile::Mode::read, source), header_(io::arrays::read_npy_header(source, file_)) {
        const std::vector<std::size_t>& shape = header_.shape = without_batches(header_.shape);
        if (shape.size() != 4 && shape.size() != 5)
            fail_source(source, "views are an array of the axes row of views, column of views, y, x and channel");
        if (shape.size() == 4) header_.shape.push_back(1);
        if (header_.by_columns)
            fail_source(source, "is an array by columns (fortran_order); numpy.ascontiguousarray() makes one by rows");
        if (header_.complex ||
            (header_.number != Number::uint8 && header_.number != Number::uint16 && header_.number != Number::single))
            fail_source(source, "views are numbers of type uint8, uint16 or float32");
        for (const std::size_t extent : shape)
            if (extent == 0) fail_source(source, "is an array without elements");
        if (shape[4] != 1 && shape[4] != 3)
            fail_source(source, fmt::format("has {} channels, but 1 or 3 are read", shape[4]));
        if (shape[2] > max_pixels / shape[3]) fail_source(source, "its views have too many pixels");
    }
    const std::vector<std::size_t>& shape() const { return header_.shape; }

    image::Picture read(std::size_t row, std::size_t column) const override {
        if (header_.number == Number::uint8) return {load<std::uint8_t>(row, column), {}};
        if (header_.number == Number::uint16) return {load<std::uint16_t>(row, column), {}};
        return {load<float>(row, column), {}};
    }
    std::string name(std::size_t row, std::size_t column) const override {
        return fmt::format("{}, view [{}, {}]", file_.name().string(), row, column);
    }

  private:
    template <class T>
    Array<T, 3> load(std::size_t row, std::size_t column) const {
        Array<T, 3> view({shape()[2], shape()[3], shape()[4]});
        const std::size_t bytes = view.size() * sizeof(T);
        file_.read(header_.begin + (row * shape()[1] + column) * bytes, view.data(), bytes);
        if (header_.big_endian)
            for (T& value : view.elements()) {
                auto* const first = reinterpret_cast<unsigned char*>(&value);
                std::reverse(first, first + sizeof(T));
            }
        return view;
    }

    core::RawFile file_;
    NpyHeader header_;
};

ViewSet open(const fs::path& source, const ViewImportOptions& options) {
    const auto pictures = std::make_shared<NpyPictures>(source);
    ViewSet set;
    set.rows = pictures->shape()[0];
    set.columns = pictures->shape()[1];
    set.pictures = pictures;
    set.geometry.orthographic = options.orthographic.value_or(false);
    return set;
}

class Writer final : public ViewWriter {
  public:
    explicit Writer(const ViewTarget& target)
        : target_(target),
          output_(target.path),
          file_(output_.temporary(), core::RawFile::Mode::create, target.path),
          bytes_(target.bits <= 8    ? 1
                 : target.bits <= 16 ? 2
                                     : 4) {
        const std::vector<std::size_t> shape{target.rows, target.columns, target.height, target.width, target.channels};
        const std::string start = io::arrays::npy_beginning(bytes_ == 1 ? "|u1" : bytes_ == 2 ? "<u2" : "<f4", shape);
        begin_ = start.size();
        file_.write(0, start.data(), start.size());
    }

    fs::path write(std::size_t row, std::size_t column, const StoredView& view) override {
        std::visit(
            [&](const auto& samples) {
                const std::size_t bytes = samples.size() * bytes_;
                file_.write(begin_ + (row * target_.columns + column) * bytes, samples.data(), bytes);
            },
            view);
        return {};
    }

    std::vector<fs::path> finish() override {
        file_.close();
        output_.commit();
        return {target_.path};
    }

  private:
    ViewTarget target_;
    core::OutputFile output_;
    core::RawFile file_;
    std::size_t bytes_, begin_ = 0;
};

}  // namespace

ViewLayout npy_layout() {
    return {.name = "npy",
            .text = "NumPy array [row of views][column of views][y][x][channel] of uint8, uint16 or float32",
            .is_folder = false,
            .cameras_only = false,
            .has_pictures = false,
            .probe = probe,
            .open = open,
            .create = [](const ViewTarget& target) -> std::unique_ptr<ViewWriter> {
                return std::make_unique<Writer>(target);
            }};
}

}  // namespace hogel::exchange
