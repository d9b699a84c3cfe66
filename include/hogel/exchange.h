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

/// Sets of views: pictures of a scene from a rectangular array of cameras, as other programs store light fields. The
/// plane on which all views agree becomes the hologram. A pixel there is a hogel, and a camera is a direction: the
/// cameras lie on a fixed focal plane in front of the hologram (docs/exchange.md).

/// Transfer curve between picture values, 0 to 1, and linear light. Values of `linear` may exceed 1.
enum class Transfer { srgb, linear, rec709, gamma22 };
/// Returns the names of the curves in the order of the enumeration: "srgb", "linear", "rec709", "gamma2.2".
HOGEL_API const std::vector<std::string>& transfer_names();
/// Returns the curve of this name; nothing for an empty name. Throws Error(usage) for an unknown name.
HOGEL_API std::optional<Transfer> transfer_named(const std::string& name);

/// Import options, and camera parameters that the files do not contain. Lengths are in metres, at the hologram. Values
/// given by neither the files nor the options are assumed, and listed in ImportedViews::assumed.
struct ViewImportOptions {
    std::string layout;              ///< name of a row of view_layouts(); empty: the first that recognises the source
    double size = 0;                 ///< width of the hologram; 0: as the files say
    std::optional<double> distance;  ///< from the cameras to the hologram plane
    std::optional<double> spacing;   ///< between neighbouring cameras of a row
    std::optional<double> field_of_view;  ///< full horizontal angle of a row of views, seen from the hologram, radians
    std::optional<Transfer> transfer;     ///< default: sRGB for whole numbers, linear for floating-point numbers
    std::optional<bool> orthographic;     ///< whether a view has one direction instead of one viewpoint
    std::optional<bool> column_first = {};  ///< whether the first of two numbers in a file name is the column
    std::size_t columns = 0, rows = 0;      ///< number of views, if a single number counts them; 0: as recognised
    /// Number of views to import from the middle of the set; 0: all.
    std::size_t middle_columns = 0, middle_rows = 0;
    bool mirror_columns = false;  ///< whether the order of view columns is opposite to that of the layout
    bool mirror_rows = false;     ///< the same for rows
    /// Disparity of the plane that becomes the hologram: its shift to the left from a view to its right neighbour,
    /// pixels. 0: the plane on which the views agree. Views are sheared accordingly and cropped to their common area.
    double disparity = 0;
    /// Factor by which interpolation increases the number of view steps: densify − 1 new views between neighbours, from
    /// the disparity of the set. A set without disparity needs `estimate_disparity`.
    std::size_t densify = 1;
    bool estimate_disparity = false;
    /// Whether the light field has depth, computed from the same disparity.
    bool with_depth = false;
    /// Code values per metre in integer depth maps, or per pixel in integer disparity maps; 0: none given.
    double depth_scale = 0;
    double memory = 1e9;  ///< bytes of pictures in memory
    /// Folder of a temporary file for pictures beyond `memory`, so that each is decoded once. Empty: no such file.
    std::filesystem::path spool = {};
};

/// A light field made of a set of views, and its recognised geometry.
struct ImportedViews {
    LightField light_field;             ///< reads the pictures when it is read; see import_views()
    std::string layout;                 ///< name of a row of view_layouts()
    std::size_t columns = 0, rows = 0;  ///< number of views, including interpolated ones
    unsigned bits = 8;                  ///< per sample of the pictures; 32: floating-point numbers
    Transfer transfer = Transfer::srgb;
    double spacing = 0, distance = 0;  ///< of the cameras at the hologram, metres; 0 for orthographic views
    double scale = 0;                  ///< size at the hologram divided by the size in the set; 0: the set does not say
    /// Largest parallax between the middle view and its neighbours, pixels: 98th percentile over textured blocks.
    double parallax = 0;
    bool estimated = false;  ///< whether the disparity was estimated
    double spool_bytes = 0;  ///< size of the temporary file in ViewImportOptions::spool, after the views are read
    std::string summary;     ///< geometry in one line
    std::vector<std::string> assumed;  ///< assumed values that neither the set nor the options gave
    std::vector<std::string> notes;    ///< other findings about the set
};

/// Returns whether the source is a set of views that a layout recognises: a folder, or a file such as a quilt.
HOGEL_API bool is_view_set(const std::filesystem::path& source);

/// Opens a set of views as a light field. Views that fit into options.memory are decoded once, on all threads, at the
/// first read. Larger sets are held in bands of rows: read them in tile order (write_views()). Each band decodes every
/// picture again unless options.spool is set. Throws Error(bad_input), with the file name, for missing views, pictures
/// of different sizes, and damaged pictures (some only when read); Error(usage) for options that contradict the set.
HOGEL_API ImportedViews import_views(const std::filesystem::path& source, const ViewImportOptions& options,
                                     const Progress& progress = {});

/// Estimates the resources to import a set of views and write it to an uncompressed file.
HOGEL_API Plan plan_import(const ImportedViews& views, const ViewImportOptions& options,
                           const LightFieldFileOptions& file = {});

/// Copies an imported light field to a sink, band by band on all threads. Memory: a band, and a hogel row per thread.
HOGEL_API void write_views(const LightField& light_field, LightFieldSink& sink, const Progress& progress = {});

/// A display that shows a quilt: a picture of one row of cameras as tiles (docs/exchange.md).
struct QuiltDisplay {
    std::string name;                       ///< "lkg-portrait"
    std::size_t columns = 0, rows = 0;      ///< of tiles, one a view
    std::size_t width = 0, height = 0;      ///< of the quilt, pixels
    double aspect = 0;                      ///< width/height of the display; pixels of a tile need not be square
    double cone = 0;                        ///< full angle of the cameras, seen from the display, radians
    std::string source = {};                ///< address of the figures
    std::string title = {};                 ///< maker and model
    std::vector<std::string> aliases = {};  ///< other names, for find_quilt_display()
    bool verified = true;                   ///< whether the figures were compared with `source`
    std::string note = {};                  ///< one line for its user
    std::string fault = {};                 ///< why the user's profile cannot be used, or empty

    /// Return the pixels of a tile. The rest of a quilt that does not divide is a black margin, right and at the top.
    std::size_t tile_width() const { return width / columns; }
    std::size_t tile_height() const { return height / rows; }
};

/// Returns all displays for quilts, those with the fewest pixels first: of hogel's profiles and of the user's, as
/// modulators() does.
HOGEL_API Table<QuiltDisplay>& quilt_displays();

/// Returns the names and aliases of quilt_displays().
HOGEL_API std::vector<std::string> quilt_display_names();

/// Returns the row of quilt_displays() with this name or alias, in upper or lower case. Throws Error(usage) for an
/// unknown name and for a device of another kind, and Error(bad_input) for a profile of the user with a fault.
HOGEL_API QuiltDisplay find_quilt_display(const std::string& name);

/// Returns what the user of a display should know: that its profile is not verified, and the profile's note.
HOGEL_API std::vector<std::string> notes_about(const QuiltDisplay& display);

/// Options of export_views().
struct ViewExportOptions {
    std::string layout = "rows-columns";    ///< name of a row of view_layouts()
    std::string format = {};                ///< "png", "ppm", "pfm" or "exr"; empty: as imported, else "png"
    unsigned bits = 0;                      ///< of integer samples, 8 to 16; 0: as imported, else 8
    std::optional<Transfer> transfer = {};  ///< default: as imported, else sRGB, or linear for floating-point numbers
    /// Factor of linear values. 0: automatic_exposure() of the middle view, except for imported views and
    /// floating-point formats, which have 1.
    double exposure = 1;
    double memory = 1e9;  ///< bytes of views in memory
    /// Display of a quilt, whose views are resampled to its tiles. Default: tiles have a pixel for each hogel.
    std::optional<QuiltDisplay> display = {};
    /// Metadata of each PNG and EXR file, before the light field's own provenance.
    Metadata metadata = {};
};

/// The result of export_views().
struct ExportedViews {
    std::size_t columns = 0, rows = 0;         ///< number of views
    std::vector<std::filesystem::path> files;  ///< in writing order
    std::vector<std::string> notes = {};       ///< remarks for users of the set
    double exposure = 1;                       ///< factor of linear values
};

/// Writes a light field as a set of views: one view per direction, one pixel per hogel. With a fixed focal plane in
/// front of the hologram the views are pictures of cameras there. Otherwise they are orthographic, which layouts of
/// cameras refuse. It is the inverse of import_views(): integers of 8 to 16 bits are restored exactly if the light
/// field's samples are precise enough; half floats restore integers up to 11 bits. A quilt gets the middle row of
/// views. Throws Error(usage) if the layout cannot hold the views, Error(cannot_write).
/// @param target  an existing folder, or a file for some layouts
HOGEL_API ExportedViews export_views(const LightField& light_field, const std::filesystem::path& target,
                                     const ViewExportOptions& options, const Progress& progress = {});

/// Estimates the resources of export_views(), without the cost of reading the light field. Disk space is an upper
/// bound.
HOGEL_API Plan plan_export(const LightField& light_field, const ViewExportOptions& options);

/// Writes the cameras that produce a light field of this grid as transforms.json (nerfstudio, instant-ngp), for
/// rendering with another program. The cameras are pinholes on the fixed focal plane, with axes perpendicular to the
/// hologram and one pixel per hogel. The frame is that of docs/notation.md, in metres, with its origin at the centre of
/// the hologram. Picture names are 000_000.png and so on: row from the top, column from the left. Returns remarks for
/// users of the cameras. Throws Error(usage) for a grid without a fixed focal plane in front of the hologram,
/// Error(cannot_write).
HOGEL_API std::vector<std::string> write_cameras(const LightFieldGrid& grid, const std::filesystem::path& file);

namespace exchange {
struct ViewSet;
class ViewWriter;
struct ViewTarget;
}  // namespace exchange

/// A file layout of sets of views.
struct ViewLayout {
    std::string name;              ///< "hci"
    std::string text;              ///< one line
    bool is_folder = true;         ///< whether a set is a folder, not a file
    bool cameras_only = true;      ///< whether it cannot hold orthographic views
    bool has_pictures = true;      ///< whether views are stored in a picture format
    bool is_row = false;           ///< whether a set is one row of cameras
    bool written_at_once = false;  ///< whether all views are in memory until the last is complete
    bool (*probe)(const std::filesystem::path& source) = nullptr;  ///< whether a source is such a set
    exchange::ViewSet (*open)(const std::filesystem::path& source, const ViewImportOptions& options) = nullptr;
    /// Null if such sets can only be read.
    std::unique_ptr<exchange::ViewWriter> (*create)(const exchange::ViewTarget& target) = nullptr;
};

/// Returns all layouts. The first one that recognises a source is used.
HOGEL_API Table<ViewLayout>& view_layouts();

/// Films are written and read by the program ffmpeg, found in PATH when needed; the library does not link to it.

/// Returns whether ffmpeg is installed.
HOGEL_API bool can_make_films();

/// Returns whether a name is that of a film: .mp4, .gif or .apng, without a number pattern ("####").
HOGEL_API bool is_film(const std::filesystem::path& path);

/// Encodes the pictures of a folder as a film (.mp4, .gif or .apng). Throws Error(not_built_in) without ffmpeg,
/// Error(cannot_write) if it fails.
/// @param frames   pattern of the picture names: "%06d.png"
/// @param comment  stored in the film
HOGEL_API void make_film(const std::filesystem::path& film, const std::filesystem::path& folder,
                         const std::string& frames, double frames_a_second, const std::string& comment = {},
                         const Progress& progress = {});

}  // namespace hogel
