// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "command_line.h"
#include "hogel/pipeline.h"
#include "hogel/requests.h"
#include "session.h"

namespace hogel::cli {

// The functions that follow set the values of options that act, and what decides which do.

/// A built-in scene in the size of the hologram, or a mesh file, fitted to it if requested, with lights.
Scene load_scene(const Session& session, const std::string& name, LightFieldParameters& options);

/// Shades the scene and prints the resources that this takes.
std::shared_ptr<const ShadedScene> light_scene(const Session& session, const Scene& scene,
                                               LightFieldParameters& options);

/// The light field of a scene, rendered when it is read.
LightField render_light_field(const Session& session, const Scene& scene, LightFieldParameters& options);

/// Throws Error(usage) where rendering would take more memory than there is.
void require_memory(const Session& session, const LightField& rendered, const LightFieldParameters& options,
                    const Scene& scene);

/// The light field of a file, or of a scene, which is rendered when it is read.
LightField open_or_render(const Session& session, const std::string& name, LightFieldParameters& options);

/// Opens a hologram or another program's field as FieldParameters::open_and_reconstruct() does, and prints the notes.
Fields open_and_reconstruct(const Session& session, const std::string& name, FieldParameters& options);

/// See prepare_for_reading() in hogel/pipeline.h.
LightField prepare_for_reading(const Session& session, const LightField& light_field, std::size_t times,
                               bool with_depth);

}  // namespace hogel::cli
