#pragma once

#include "hogel/io/hdf5_internal.h"
#include "hogel/lightfield/light_field.h"
#include "hogel/optics/field.h"

namespace hogel {

/// The sampling of a light field as attributes of "radiance", and back. The readers check all that can be known
/// without reading samples. They need a Session.
hdf5::Attributes light_field_attributes(const LightFieldGrid& grid);
LightFieldGrid read_light_field_grid(hid_t file, const std::filesystem::path& path);

/// The same for the fields of a hologram, one for each group "field<i>".
std::vector<FieldGrid> read_hologram_grids(hid_t file, const std::filesystem::path& path);

}  // namespace hogel
