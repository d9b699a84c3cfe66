// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hogel/field.h"
#include "hogel/io/hdf5/dataset.h"
#include "hogel/light_field.h"

namespace hogel::io::hdf5 {

/// Returns the grid of each face of a light field, the front first, from the attributes of its "radiance". Checks
/// everything except the samples. Throws Error(bad_input). Requires a Session.
std::vector<LightFieldGrid> read_light_field_grids(hid_t file, const std::filesystem::path& path);

/// Returns the grids of a hologram's fields, one per group "field<i>". Throws Error(bad_input). Requires a Session.
std::vector<FieldGrid> read_hologram_grids(hid_t file, const std::filesystem::path& path);

/// Opens the radiance of a light field's front face with this grid. Requires a Session.
DatasetReader radiance_of_front(hid_t file, const LightFieldGrid& grid,
                                const std::shared_ptr<const core::RawFile>& raw);

/// Opens the samples of field number `field` of a hologram, with this grid. Requires a Session.
DatasetReader samples_of_field(hid_t file, std::size_t field, const FieldGrid& grid,
                               const std::shared_ptr<const core::RawFile>& raw);

}  // namespace hogel::io::hdf5
