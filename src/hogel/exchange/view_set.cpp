// SPDX-License-Identifier: Apache-2.0
#include "hogel/exchange/view_set.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <fstream>

#include "hogel/error.h"
#include "hogel/exchange/file_names.h"
#include "hogel/image/picture_bytes.h"

namespace hogel {

Table<ViewLayout>& view_layouts() {
    using namespace exchange;
    static Table<ViewLayout> table("layout",
                                   {transforms_layout(), hci_layout(), stanford_layout(), quilt_layout(), npy_layout(),
                                    mat_layout(), film_layout(), rows_columns_layout(), numbered_layout()},
                                   "layout");
    return table;
}

bool is_view_set(const std::filesystem::path& source) {
    for (const ViewLayout& layout : view_layouts().rows())
        if (layout.probe(source)) return true;
    return false;
}

namespace exchange {
namespace {

class ReorderedPictures final : public ViewPictures {
  public:
    using Order = std::function<std::pair<std::size_t, std::size_t>(std::size_t, std::size_t)>;
    ReorderedPictures(std::shared_ptr<const ViewPictures> pictures, Order order)
        : pictures_(std::move(pictures)), order_(std::move(order)) {}
    image::Picture read(std::size_t row, std::size_t column) const override {
        const auto [r, c] = order_(row, column);
        return pictures_->read(r, c);
    }
    std::string name(std::size_t row, std::size_t column) const override {
        const auto [r, c] = order_(row, column);
        return pictures_->name(r, c);
    }
    std::shared_ptr<const image::Picture> look(std::size_t row, std::size_t column) const override {
        const auto [r, c] = order_(row, column);
        return pictures_->look(r, c);
    }
    void forget() const override { pictures_->forget(); }

  private:
    std::shared_ptr<const ViewPictures> pictures_;
    Order order_;
};

// Returns a clause that names a subfolder that is a set, or an empty string.
std::string set_below(const std::filesystem::path& source) {
    std::error_code error;
    std::vector<std::filesystem::path> folders;
    for (const auto& entry : std::filesystem::directory_iterator(source, error))
        if (entry.is_directory(error) && folders.size() < 100) folders.push_back(entry.path());
    std::ranges::sort(folders);
    for (const std::filesystem::path& folder : folders)
        if (is_view_set(folder)) return fmt::format(", but {} is one", folder.string());
    return {};
}

// Returns a clause that explains why the pictures are not recognised, or an empty string.
std::string names_that_differ(const std::filesystem::path& source) {
    const std::vector<NumberedFiles> groups = numbered_pictures(source);
    if (groups.empty() || groups.front().files.size() < 3 || groups.front().varying.size() < 3) return {};
    return fmt::format(", because the names of {} pictures such as {} differ in {} numbers and not in one or two",
                       groups.front().files.size(), groups.front().files.front().path.filename().string(),
                       groups.front().varying.size());
}

ViewLayout layout_of(const std::filesystem::path& source, const ViewImportOptions& options) {
    if (!options.layout.empty()) return view_layouts().find(options.layout);
    for (const ViewLayout& layout : view_layouts().rows())
        if (layout.probe(source)) return layout;
    // Two pictures with numbers are a set if it is known how many there are.
    const std::vector<NumberedFiles> groups = numbered_pictures(source);
    if (options.columns > 0 && !groups.empty() && groups.front().varying.size() == 1) return numbered_layout();
    fail_source(source, fmt::format("is no set of views that is recognised{}{}; layouts are {}", set_below(source),
                                    names_that_differ(source), fmt::join(view_layouts().names(), ", ")));
}

}  // namespace

void fail_source(const std::filesystem::path& source, const std::string& why) {
    throw Error(ErrorCode::bad_input, fmt::format("{}: {}", source.string(), why));
}

std::string read_text(const std::filesystem::path& file, std::uintmax_t max_bytes) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) fail_source(file, "is not a regular file");  // a pipe may wait
    const std::uintmax_t size = std::filesystem::file_size(file, error);
    if (error) fail_source(file, "cannot be read");
    if (size > max_bytes) fail_source(file, fmt::format("is larger than the {} bytes that are read", max_bytes));
    std::string text(size, '\0');
    std::ifstream stream(file, std::ios::binary);
    if (!stream.read(text.data(), static_cast<std::streamsize>(size))) fail_source(file, "cannot be read");
    return text;
}

std::uint32_t max_code_of(const image::Picture& picture) {
    if (std::holds_alternative<Array<float, 3>>(picture.samples)) return 0;
    if (picture.max_code > 0) return picture.max_code;
    return std::holds_alternative<Array<std::uint8_t, 3>>(picture.samples) ? 255 : 65535;
}

unsigned bits_of(const image::Picture& picture) {
    const std::uint32_t max = max_code_of(picture);
    return max == 0 ? 32 : std::max(8u, static_cast<unsigned>(std::bit_width(max)));
}

std::shared_ptr<const image::Picture> ViewPictures::look(std::size_t row, std::size_t column) const {
    return looked_at_.get({row, column}, [&] { return std::make_shared<const image::Picture>(read(row, column)); });
}

image::Picture FilePictures::read(std::size_t row, std::size_t column) const {
    return image::read_picture(files_[row * columns_ + column], max_pixels);
}

std::string FilePictures::name(std::size_t row, std::size_t column) const {
    return files_[row * columns_ + column].string();
}

ViewSet reordered(ViewSet set, std::size_t rows, std::size_t columns, ReorderedPictures::Order order) {
    set.pictures = std::make_shared<ReorderedPictures>(std::move(set.pictures), std::move(order));
    set.rows = rows;
    set.columns = columns;
    return set;
}

ViewSet mirrored(ViewSet set, bool columns, bool rows) {
    if (!columns && !rows) return set;
    const std::size_t n = set.columns, m = set.rows;
    return reordered(std::move(set), m, n, [=](std::size_t row, std::size_t column) {
        return std::pair(rows ? m - 1 - row : row, columns ? n - 1 - column : column);
    });
}

ViewSet transposed(ViewSet set) {
    const std::size_t n = set.columns, m = set.rows;
    return reordered(std::move(set), n, m, [](std::size_t row, std::size_t column) { return std::pair(column, row); });
}

ViewSet middle_of(ViewSet set, std::size_t columns, std::size_t rows) {
    if (columns == 0 || rows == 0) return set;
    if (columns > set.columns || rows > set.rows || (set.columns - columns) % 2 != 0 || (set.rows - rows) % 2 != 0)
        throw Error(
            ErrorCode::usage, "middle",
            fmt::format("the middle {}x{} of {}x{} views were asked for; as many must be left out on both sides",
                        columns, rows, set.columns, set.rows));
    const std::size_t left = (set.columns - columns) / 2, top = (set.rows - rows) / 2;
    return reordered(std::move(set), rows, columns,
                     [=](std::size_t row, std::size_t column) { return std::pair(row + top, column + left); });
}

void take_size(const image::Picture& picture, ViewSet& set) {
    std::visit(
        [&](const auto& samples) {
            set.height = samples.extent(0);
            set.width = samples.extent(1);
            set.channels = samples.extent(2);
        },
        picture.samples);
}

void require_plausible(const std::filesystem::path& source, const ViewSet& set) {
    constexpr double longest = 8;  // maximum ratio of the sides of a pixel
    const double height = set.geometry.pixel_height;
    if (!(height >= 1 / longest && height <= longest))
        fail_source(source,
                    fmt::format("says that its pixels are {:.3g} times as high as wide, but {:.3g} to {:.3g} is "
                                "read",
                                height, 1 / longest, longest));
}

ViewSet open_views(const std::filesystem::path& source, const ViewImportOptions& options) {
    const ViewLayout layout = layout_of(source, options);
    if (!std::filesystem::exists(source)) fail_source(source, "no such file or folder");
    if (layout.is_folder && !std::filesystem::is_directory(source) && !layout.probe(source))
        fail_source(source, fmt::format("is not a folder, as sets of the layout '{}' are", layout.name));
    ViewSet set = layout.open(source, options);
    set.layout = layout.name;
    set = middle_of(mirrored(std::move(set), options.mirror_columns, options.mirror_rows), options.middle_columns,
                    options.middle_rows);
    const std::shared_ptr<const image::Picture> first = set.pictures->look(0, 0);
    set.bits = bits_of(*first);
    set.max_code = max_code_of(*first);
    take_size(*first, set);
    require_plausible(source, set);
    return set;
}

}  // namespace exchange
}  // namespace hogel
