// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hogel/export.h"
#include "hogel/light_field.h"
#include "hogel/progress.h"
#include "hogel/table.h"

namespace hogel {

/// Sets of views: the same scene photographed by a rectangle of cameras, as other programs store light fields. The
/// pixel on the plane on which all views agree is a hogel, and the camera is a direction: that plane becomes the
/// hologram, and the cameras are a fixed focal plane in front of it (docs/exchange.md).

/// The curve between the numbers of a picture, 0 to 1, and linear light. `linear` numbers may exceed 1.
enum class Transfer { srgb, linear, rec709, gamma22 };
/// The words for them, in the order of the values: "srgb", "linear", "rec709", "gamma2.2".
HOGEL_API const std::vector<std::string>& transfer_names();

/// What is to be done with a set of views, and what the set does not say of itself. Lengths are those at the hologram,
/// metres. What neither says is assumed, and ImportedViews::assumed names it.
struct ViewOptions {
    std::string layout;                     ///< a name in view_layouts(); empty: the one that recognises the source
    double size = 0;                        ///< width of the hologram
    std::optional<double> distance;         ///< from the cameras to the hologram plane
    std::optional<double> spacing;          ///< between neighbouring cameras of a row
    std::optional<double> field_of_view;    ///< full angle that a row of views spans from the hologram, radians
    std::optional<Transfer> transfer;       ///< otherwise sRGB for whole numbers, linear for floating-point ones
    std::optional<bool> orthographic;       ///< whether a view is taken along one direction instead of from one point
    std::optional<bool> column_first = {};  ///< which of two numbers in the names of files is the column
    std::size_t columns = 0, rows = 0;      ///< of views, where one number counts them all
    bool mirror_columns = false;            ///< whether columns of views are the other way round than the layout says
    bool mirror_rows = false;               ///< likewise of rows
    /// Pixels by which the plane that is to be the hologram moves to the left from a view to the one on its right; 0
    /// for the plane on which the views agree. Views are sheared accordingly and cropped to what all of them show.
    double disparity = 0;
    double memory = 1e9;  ///< bytes of pictures held at any time
};

/// A light field made of a set of views, and the geometry as it was understood.
struct ImportedViews {
    LightField light_field;             ///< reads the pictures when it is read; see import_views()
    std::string layout;                 ///< a name in view_layouts()
    std::size_t columns = 0, rows = 0;  ///< of views
    unsigned bits = 8;                  ///< of the pictures' samples; 32: floating-point numbers
    Transfer transfer = Transfer::srgb;
    double spacing = 0, distance = 0;  ///< of the cameras at the hologram; of orthographic views 0
    double scale = 0;                  ///< size at the hologram by the size in the set; 0 where the set does not say
    /// The largest parallax from one view to the next, in pixels: the 98th percentile over blocks with texture, between
    /// the middle view and its neighbours.
    double parallax = 0;
    std::string summary;               ///< the geometry, one line
    std::vector<std::string> assumed;  ///< what neither the set nor the options said, and what was taken
    std::vector<std::string> notes;    ///< what was found out about the set
};

/// Whether the source is a set of views that a layout recognises: a folder, or a file such as a quilt.
HOGEL_API bool is_view_set(const std::filesystem::path& source);

/// Opens a set of views as a light field. Views that fit into options.memory are decoded once, by all threads, when
/// they are first read; larger sets are held in bands of rows, each of which decodes every picture, so that they are to
/// be read in the order of tiles: write_views(). Throws Error(bad_input), naming the file, for a set with a hole, for
/// pictures of different sizes, and for damaged ones (some of them only when they are read); Error(usage) for options
/// that contradict the set.
HOGEL_API ImportedViews import_views(const std::filesystem::path& source, const ViewOptions& options,
                                     const Progress& progress = {});

/// Copies an imported light field to a sink, band by band, with all threads. Memory: one band, and a row of hogels for
/// each thread.
HOGEL_API void write_views(const LightField& light_field, LightFieldSink& sink, const Progress& progress = {});

/// How a light field is written as a set of views.
struct ViewExportOptions {
    std::string layout = "rows-columns";    ///< a name in view_layouts()
    std::string format = {};                ///< "png", "ppm", "pfm" or "exr"; empty: as imported, else "png"
    unsigned bits = 0;                      ///< of whole numbers: 8 to 16; 0: as imported, else 8
    std::optional<Transfer> transfer = {};  ///< otherwise as imported, else sRGB, or linear for floating-point numbers
    double exposure = 1;                    ///< factor of linear values that become whole numbers
    double memory = 1e9;                    ///< bytes of views held at any time
};

/// What export_views() wrote.
struct ExportedViews {
    std::size_t columns = 0, rows = 0;         ///< of views
    std::vector<std::filesystem::path> files;  ///< in order of writing
};

/// Writes a light field as a set of views: one for each direction, with a pixel for each hogel. With a fixed focal
/// plane in front of the hologram these are what cameras there see; otherwise they are orthographic views, and layouts
/// of cameras refuse them. The inverse of import_views(): numbers of 8 to 16 bits come back as they were if the light
/// field holds them exactly enough, half floats those of 11 bits. `target` is a folder, which must exist, or for some
/// layouts a file. Throws Error(usage) for what the layout cannot hold, Error(cannot_write).
HOGEL_API ExportedViews export_views(const LightField& light_field, const std::filesystem::path& target,
                                     const ViewExportOptions& options, const Progress& progress = {});

namespace exchange {
struct ViewSet;
class ViewWriter;
struct ViewTarget;
}  // namespace exchange

/// One way to store a set of views.
struct ViewLayout {
    std::string name;                                              ///< "hci"
    std::string text;                                              ///< what it is, one line
    bool is_folder = true;                                         ///< whether a set is a folder rather than a file
    bool cameras_only = true;                                      ///< whether it cannot hold orthographic views
    bool (*probe)(const std::filesystem::path& source) = nullptr;  ///< whether a source is such a set
    exchange::ViewSet (*open)(const std::filesystem::path& source, const ViewOptions& options) = nullptr;
    /// Null where such sets are only read.
    std::unique_ptr<exchange::ViewWriter> (*create)(const exchange::ViewTarget& target) = nullptr;
};

/// All layouts; of several that recognise a source the first is taken.
HOGEL_API Table<ViewLayout>& view_layouts();

}  // namespace hogel
