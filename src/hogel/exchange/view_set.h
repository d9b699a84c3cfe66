// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "hogel/exchange.h"
#include "hogel/image/formats/formats.h"
#include "hogel/work/lru_cache.h"

/// A set of views, however it is stored. Views are in the order of their cameras: column 0 is the leftmost camera, row
/// 0 the topmost, as their owner sees them who looks at the scene. An eye on the left sees column 0.
namespace hogel::exchange {

/// Pictures up to this size are read.
constexpr std::size_t max_pixels = std::size_t{1} << 28;

/// The pictures of a set. read() may be called from several threads at once.
class ViewPictures {
  public:
    virtual ~ViewPictures() = default;
    /// The picture of a view as it is stored. Throws Error(bad_input).
    virtual image::Picture read(std::size_t row, std::size_t column) const = 0;
    /// What messages call it.
    virtual std::string name(std::size_t row, std::size_t column) const = 0;
    /// The same picture for those that look at a few views before all are read: it is kept until forget().
    virtual std::shared_ptr<const image::Picture> look(std::size_t row, std::size_t column) const;
    virtual void forget() const { looked_at_.clear(); }

  private:
    static constexpr std::size_t kept = 12;
    mutable work::LruCache<std::pair<std::size_t, std::size_t>, image::Picture> looked_at_{kept};
};

/// What a set says of its cameras; lengths in metres at the size of the scene, 0 for what it does not say.
struct ViewGeometry {
    bool orthographic = false;  ///< whether a view is taken along one direction instead of from one point
    double spacing = 0;         ///< between neighbouring cameras of a row; of orthographic views the step of U
    double spacing_ratio = 1;   ///< that of a column relative to that of a row
    double distance = 0;        ///< from the cameras to the plane on which views agree; infinite for parallel cameras
    double pixel_height = 1;    ///< of a pixel as it is shown, by its width
    double pixel_tangent = 0;   ///< the tangent between neighbouring pixels, 1/(focal length in pixels)
    /// The middle of the pictures as the camera in the middle sees it: its direction (x to the right, y up, 1 ahead).
    double center_u = 0, center_v = 0;
};

struct ViewSet {
    std::string layout;                               ///< filled by open_views()
    std::size_t columns = 0, rows = 0;                ///< of views
    std::size_t width = 0, height = 0, channels = 0;  ///< of each picture; filled by open_views()
    unsigned bits = 0;                                ///< likewise: 8 to 16, or 32 for floating-point numbers
    std::uint32_t max_code = 0;  ///< likewise: the largest code, 255 to 65535; 0 for floating-point numbers
    ViewGeometry geometry;
    std::shared_ptr<const ViewPictures> pictures;
    std::vector<std::string> notes;  ///< what was found out about the set
};

/// Takes the height, width and channels of a set from one of its pictures.
void take_size(const image::Picture& picture, ViewSet& set);

/// Opens a set with the layout that options.layout names or that recognises it, looks at its first picture, and mirrors
/// it as the options say. Throws as import_views() does.
ViewSet open_views(const std::filesystem::path& source, const ViewImportOptions& options);

/// The bits of a picture's samples: 8 to 16, or 32 for floating-point numbers.
unsigned bits_of(const image::Picture& picture);

/// The largest code of a picture; 0 for floating-point numbers.
std::uint32_t max_code_of(const image::Picture& picture);

/// Pictures that are files, [row][column].
class FilePictures final : public ViewPictures {
  public:
    FilePictures(std::vector<std::filesystem::path> files, std::size_t columns)
        : files_(std::move(files)), columns_(columns) {}
    image::Picture read(std::size_t row, std::size_t column) const override;
    std::string name(std::size_t row, std::size_t column) const override;

  private:
    std::vector<std::filesystem::path> files_;
    std::size_t columns_;
};

/// The same set with views in another order: that of (row, column) is at order(row, column) in `set`.
ViewSet reordered(ViewSet set, std::size_t rows, std::size_t columns,
                  std::function<std::pair<std::size_t, std::size_t>(std::size_t, std::size_t)> order);
ViewSet mirrored(ViewSet set, bool columns, bool rows);
ViewSet transposed(ViewSet set);
/// The views in the middle. Throws Error(usage) for more than there are, and where as many are not in the middle.
ViewSet middle_of(ViewSet set, std::size_t columns, std::size_t rows);

/// Throws Error(bad_input): "SOURCE: why".
[[noreturn]] void fail_source(const std::filesystem::path& source, const std::string& why);

/// The bytes of a regular file that describes a set. Throws Error(bad_input) for another kind of file, and for more
/// than `max_bytes`.
std::string read_text(const std::filesystem::path& file, std::uintmax_t max_bytes);

/// A picture of a view on the way out: its samples as they are to be stored.
using StoredView = image::Samples;

/// What a layout must know to write a set.
struct ViewTarget {
    std::filesystem::path path;
    std::size_t columns = 0, rows = 0, width = 0, height = 0, channels = 0;
    ViewGeometry geometry;  ///< lengths at the hologram
    std::string format;     ///< "png", "ppm", "pfm" or "exr"; the layout's name where views are no pictures
    unsigned bits = 8;      ///< 8 to 16, or 32 for floating-point numbers
    Transfer transfer = Transfer::srgb;
    Metadata texts;  ///< for formats that hold texts
};

/// What the views of a light field are: counts and geometry. Throws Error(usage) for directions that are no views.
ViewTarget target_of(const LightFieldGrid& grid, const std::filesystem::path& path);

/// Writes a set. write() may be called from several threads at once, once for each view; finish() last.
class ViewWriter {
  public:
    virtual ~ViewWriter() = default;
    /// Codes of more than 8 bits are scaled to 16 bits. Returns the file that was written, if it is one of its own.
    virtual std::filesystem::path write(std::size_t row, std::size_t column, const StoredView& view) = 0;
    /// The files that hold all views, or that describe them.
    virtual std::vector<std::filesystem::path> finish() { return {}; }
    /// What a user of the set should know.
    virtual std::vector<std::string> notes() const { return {}; }
};

/// Writes each view to a file of its own, whose name, without extension, is name(row, column).
std::unique_ptr<ViewWriter> file_writer(const ViewTarget& target,
                                        std::function<std::string(std::size_t, std::size_t)> name);
/// The bytes of a picture file in the target's format.
std::vector<unsigned char> picture_file(const ViewTarget& target, const StoredView& view);

// The layouts, one a file.
ViewLayout transforms_layout();
ViewLayout hci_layout();
ViewLayout stanford_layout();
ViewLayout quilt_layout();
ViewLayout npy_layout();
ViewLayout mat_layout();
ViewLayout film_layout();
ViewLayout rows_columns_layout();
ViewLayout numbered_layout();

}  // namespace hogel::exchange
