// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hogel/exchange.h"
#include "hogel/image/formats/formats.h"
#include "hogel/work/lru_cache.h"

/// A set of views, independent of its storage. Views are in the order of their cameras, seen from behind the cameras:
/// column 0 is the leftmost camera, row 0 the topmost. A viewpoint on the left sees column 0.
namespace hogel::exchange {

constexpr std::size_t max_pixels = std::size_t{1} << 28;

/// Pictures of a set. read() is thread-safe.
class ViewPictures {
  public:
    virtual ~ViewPictures() = default;
    /// Returns the picture of a view as stored. Throws Error(bad_input).
    virtual image::Picture read(std::size_t row, std::size_t column) const = 0;
    /// Returns the name of a view for messages.
    virtual std::string name(std::size_t row, std::size_t column) const = 0;
    /// As read(), with a small cache for code that inspects a few views first; forget() clears it.
    virtual std::shared_ptr<const image::Picture> look(std::size_t row, std::size_t column) const;
    virtual void forget() const { looked_at_.clear(); }

  private:
    static constexpr std::size_t kept = 12;
    mutable work::LruCache<std::pair<std::size_t, std::size_t>, image::Picture> looked_at_{kept};
};

/// Camera geometry as stated by a set; lengths in metres at the size of the scene, 0 if not stated.
struct ViewGeometry {
    bool orthographic = false;  ///< whether views have one direction each instead of one camera position
    double spacing = 0;         ///< between neighbouring cameras of a row; step of U for orthographic views
    double spacing_ratio = 1;   ///< spacing in a column relative to that in a row
    double distance = 0;       ///< from the cameras to the zero-parallax plane; infinite for parallel unshifted cameras
    double pixel_height = 1;   ///< displayed height of a pixel relative to its width
    double pixel_tangent = 0;  ///< tangent between neighbouring pixels, 1/(focal length in pixels)
    /// Direction of the picture centres from the middle camera: (x to the right, y up, 1 ahead).
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
    std::vector<std::string> notes;  ///< findings about the set, for the user
};

/// Sets the height, width and channels of a set from one of its pictures.
void take_size(const image::Picture& picture, ViewSet& set);

/// Opens a set with the layout options.layout, or the first that recognises it; reads its first picture and mirrors it
/// as options say. Throws as import_views() does.
ViewSet open_views(const std::filesystem::path& source, const ViewImportOptions& options);

/// Returns the bits of a picture's samples: 8 to 16, or 32 for floating-point numbers.
unsigned bits_of(const image::Picture& picture);

/// Returns the largest code of a picture; 0 for floating-point numbers.
std::uint32_t max_code_of(const image::Picture& picture);

/// Pictures in files, [row][column].
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

/// Returns the set with its views reordered: new view (row, column) is view order(row, column) of `set`.
ViewSet reordered(ViewSet set, std::size_t rows, std::size_t columns,
                  std::function<std::pair<std::size_t, std::size_t>(std::size_t, std::size_t)> order);
ViewSet mirrored(ViewSet set, bool columns, bool rows);
ViewSet transposed(ViewSet set);
/// Returns the central views. Throws Error(usage) for more views than there are, and if the selection is not centred.
ViewSet middle_of(ViewSet set, std::size_t columns, std::size_t rows);

/// Throws Error(bad_input) "SOURCE: why".
[[noreturn]] void fail_source(const std::filesystem::path& source, const std::string& why);

/// Reads a file that describes a set. Throws Error(bad_input) if not regular or above `max_bytes`.
std::string read_text(const std::filesystem::path& file, std::uintmax_t max_bytes);

/// Samples of an exported view as they are to be stored.
using StoredView = image::Samples;

/// Parameters that a layout needs to write a set.
struct ViewTarget {
    std::filesystem::path path;
    std::size_t columns = 0, rows = 0, width = 0, height = 0, channels = 0;
    ViewGeometry geometry;  ///< lengths at the hologram
    std::string format;     ///< "png", "ppm", "pfm" or "exr"; the layout's name if views are not pictures
    unsigned bits = 8;      ///< 8 to 16, or 32 for floating-point numbers
    Transfer transfer = Transfer::srgb;
    Metadata texts;                       ///< metadata, for formats that store texts
    std::optional<QuiltDisplay> display;  ///< of a quilt; its tiles are width x height
};

/// Returns the counts and the geometry of a light field's views. Throws Error(usage) for directions that are not views.
ViewTarget target_of(const LightFieldGrid& grid, const std::filesystem::path& path);

/// Writer of a set. write() is thread-safe and called once for each view; finish() last.
class ViewWriter {
  public:
    virtual ~ViewWriter() = default;
    /// Writes a view; codes of more than 8 bits are scaled to 16 bits. Returns its file if each view has its own.
    virtual std::filesystem::path write(std::size_t row, std::size_t column, const StoredView& view) = 0;
    /// Writes and returns the files that hold all views or describe them.
    virtual std::vector<std::filesystem::path> finish() { return {}; }
    /// Returns notes for users of the set.
    virtual std::vector<std::string> notes() const { return {}; }
};

/// Returns a writer of one file per view, named name(row, column) plus the extension.
std::unique_ptr<ViewWriter> file_writer(const ViewTarget& target,
                                        std::function<std::string(std::size_t, std::size_t)> name);
/// Encodes a picture file in the target's format.
std::vector<unsigned char> picture_file(const ViewTarget& target, const StoredView& view);

// The layouts, one file each.
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
