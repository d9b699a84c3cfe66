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
#include "hogel/files.h"
#include "hogel/light_field.h"
#include "hogel/progress.h"
#include "hogel/resources.h"
#include "hogel/table.h"

namespace hogel {

/// Sets of views: the same scene photographed by a rectangle of cameras, as other programs store light fields. The
/// pixel on the plane on which all views agree is a hogel, and the camera is a direction: that plane becomes the
/// hologram, and the cameras are a fixed focal plane in front of it (docs/exchange.md).

/// The curve between the numbers of a picture, 0 to 1, and linear light. `linear` numbers may exceed 1.
enum class Transfer { srgb, linear, rec709, gamma22 };
/// The words for them, in the order of the values: "srgb", "linear", "rec709", "gamma2.2".
HOGEL_API const std::vector<std::string>& transfer_names();
/// The curve of that name; nothing for an empty one. Throws Error(usage) for an unknown one.
HOGEL_API std::optional<Transfer> transfer_named(const std::string& name);

/// What is to be done with a set of views, and what the set does not say of itself. Lengths are those at the hologram,
/// metres. What neither says is assumed, and ImportedViews::assumed names it.
struct ViewImportOptions {
    std::string layout;                     ///< a name in view_layouts(); empty: the one that recognises the source
    double size = 0;                        ///< width of the hologram
    std::optional<double> distance;         ///< from the cameras to the hologram plane
    std::optional<double> spacing;          ///< between neighbouring cameras of a row
    std::optional<double> field_of_view;    ///< full angle that a row of views spans from the hologram, radians
    std::optional<Transfer> transfer;       ///< otherwise sRGB for whole numbers, linear for floating-point ones
    std::optional<bool> orthographic;       ///< whether a view is taken along one direction instead of from one point
    std::optional<bool> column_first = {};  ///< which of two numbers in the names of files is the column
    std::size_t columns = 0, rows = 0;      ///< of views, where one number counts them all
    /// Views in the middle that are taken, where those at the rim are not to be; 0: all.
    std::size_t middle_columns = 0, middle_rows = 0;
    bool mirror_columns = false;  ///< whether columns of views are the other way round than the layout says
    bool mirror_rows = false;     ///< likewise of rows
    /// Pixels by which the plane that is to be the hologram moves to the left from a view to the one on its right; 0
    /// for the plane on which the views agree. Views are sheared accordingly and cropped to what all of them show.
    double disparity = 0;
    /// One more than the number of views that are interpolated between neighbours, by the disparity that comes with the
    /// set. With `estimate_disparity` a set may come without; then it is estimated.
    std::size_t densify = 1;
    bool estimate_disparity = false;
    /// Whether the light field is to have depth, by the same disparity.
    bool with_depth = false;
    /// Codes of a metre in maps of depth that are whole numbers, or of a pixel in maps of disparity; 0 for none.
    double depth_scale = 0;
    double memory = 1e9;  ///< bytes of pictures held at any time
    /// A folder for a temporary file of the size of all pictures, which is used if they do not fit into `memory`, so
    /// that each is decoded once; empty: no such file.
    std::filesystem::path spool = {};
};

/// A light field made of a set of views, and the geometry as it was understood.
struct ImportedViews {
    LightField light_field;             ///< reads the pictures when it is read; see import_views()
    std::string layout;                 ///< a name in view_layouts()
    std::size_t columns = 0, rows = 0;  ///< of views, those that were interpolated included
    unsigned bits = 8;                  ///< of the pictures' samples; 32: floating-point numbers
    Transfer transfer = Transfer::srgb;
    double spacing = 0, distance = 0;  ///< of the cameras at the hologram; of orthographic views 0
    double scale = 0;                  ///< size at the hologram by the size in the set; 0 where the set does not say
    /// The largest parallax from one view to the next, in pixels: the 98th percentile over blocks with texture, between
    /// the middle view and its neighbours.
    double parallax = 0;
    bool estimated = false;            ///< whether the disparity that was used was estimated
    double spool_bytes = 0;            ///< of the temporary file in ViewImportOptions::spool, once the views are read
    std::string summary;               ///< the geometry, one line
    std::vector<std::string> assumed;  ///< what neither the set nor the options said, and what was taken
    std::vector<std::string> notes;    ///< what was found out about the set
};

/// Whether the source is a set of views that a layout recognises: a folder, or a file such as a quilt.
HOGEL_API bool is_view_set(const std::filesystem::path& source);

/// Opens a set of views as a light field. Views that fit into options.memory are decoded once, by all threads, when
/// they are first read; larger sets are held in bands of rows, so that they are to be read in the order of tiles
/// (write_views()), and each band decodes every picture unless there is a folder for a temporary file. Throws
/// Error(bad_input), naming the file, for a set with a hole, for pictures of different sizes, and for damaged ones
/// (some of them only when they are read); Error(usage) for options that contradict the set.
HOGEL_API ImportedViews import_views(const std::filesystem::path& source, const ViewImportOptions& options,
                                     const Progress& progress = {});

/// Resources to import a set of views and write it to an uncompressed file.
HOGEL_API Plan plan_import(const ImportedViews& views, const ViewImportOptions& options,
                           const LightFieldFileOptions& file = {});

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
    /// Stored in each PNG and EXR file, before the light field's own provenance.
    Metadata metadata = {};
};

/// What export_views() wrote.
struct ExportedViews {
    std::size_t columns = 0, rows = 0;         ///< of views
    std::vector<std::filesystem::path> files;  ///< in order of writing
    std::vector<std::string> notes = {};       ///< what a user of the set should know
};

/// Writes a light field as a set of views: one for each direction, with a pixel for each hogel. With a fixed focal
/// plane in front of the hologram these are what cameras there see; otherwise they are orthographic views, and layouts
/// of cameras refuse them. The inverse of import_views(): numbers of 8 to 16 bits come back as they were if the light
/// field holds them exactly enough, half floats those of 11 bits. `target` is a folder, which must exist, or for some
/// layouts a file. Throws Error(usage) for what the layout cannot hold, Error(cannot_write).
HOGEL_API ExportedViews export_views(const LightField& light_field, const std::filesystem::path& target,
                                     const ViewExportOptions& options, const Progress& progress = {});

/// Resources to write a light field as a set of views, without the cost of reading it. The disk space is an upper
/// bound.
HOGEL_API Plan plan_export(const LightField& light_field, const ViewExportOptions& options);

/// Writes the cameras whose pictures make a light field of this grid, as transforms.json of nerfstudio and instant-ngp,
/// for another program to render: pinholes on the fixed focal plane, with axes that are perpendicular to the hologram,
/// and a pixel for each hogel. The frame is that of docs/notation.md, in metres, with its origin in the middle of the
/// hologram; the pictures are to be 000_000.png and so on, the row from the top and the column from the left. Throws
/// Error(usage) for a grid without a fixed focal plane in front of the hologram, Error(cannot_write). Returns what a
/// user of the cameras should know.
HOGEL_API std::vector<std::string> write_cameras(const LightFieldGrid& grid, const std::filesystem::path& file);

namespace exchange {
struct ViewSet;
class ViewWriter;
struct ViewTarget;
}  // namespace exchange

/// One way to store a set of views.
struct ViewLayout {
    std::string name;              ///< "hci"
    std::string text;              ///< what it is, one line
    bool is_folder = true;         ///< whether a set is a folder rather than a file
    bool cameras_only = true;      ///< whether it cannot hold orthographic views
    bool has_pictures = true;      ///< whether views are pictures of some format
    bool written_at_once = false;  ///< whether all views are held in memory until the last is there
    bool (*probe)(const std::filesystem::path& source) = nullptr;  ///< whether a source is such a set
    exchange::ViewSet (*open)(const std::filesystem::path& source, const ViewImportOptions& options) = nullptr;
    /// Null where such sets are only read.
    std::unique_ptr<exchange::ViewWriter> (*create)(const exchange::ViewTarget& target) = nullptr;
};

/// All layouts; of several that recognise a source the first is taken.
HOGEL_API Table<ViewLayout>& view_layouts();

/// Films are made and read by the program ffmpeg, which is looked for in PATH when it is needed; nothing of it is
/// linked.

/// Whether that program is installed.
HOGEL_API bool can_make_films();

/// Whether a name is that of a film: .mp4, .gif or .apng, without numbers ("####").
HOGEL_API bool is_film(const std::filesystem::path& path);

/// Makes a film (.mp4, .gif or .apng) of the pictures `frames` ("%06d.png") of a folder. `comment` is stored in it.
/// Throws Error(not_built_in) without ffmpeg, Error(cannot_write) where it fails.
HOGEL_API void make_film(const std::filesystem::path& film, const std::filesystem::path& folder,
                         const std::string& frames, double frames_a_second, const std::string& comment = {},
                         const Progress& progress = {});

}  // namespace hogel
