// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tenniel {

class NodeRegistry;

// Each adds the node types of one file (or family of files) of this folder; `node_registry` calls
// them all, once.
void register_math_nodes(NodeRegistry& registry);
void register_vector_nodes(NodeRegistry& registry);
void register_color_nodes(NodeRegistry& registry);
void register_converter_nodes(NodeRegistry& registry);
void register_input_nodes(NodeRegistry& registry);
void register_coordinate_nodes(NodeRegistry& registry);
void register_info_nodes(NodeRegistry& registry);
void register_lamp_nodes(NodeRegistry& registry);
void register_image_nodes(NodeRegistry& registry);
void register_pattern_nodes(NodeRegistry& registry);
void register_sky_nodes(NodeRegistry& registry);
void register_closure_nodes(NodeRegistry& registry);
void register_artistic_closures(NodeRegistry& registry);
void register_tracing_nodes(NodeRegistry& registry);
void register_subsurface_nodes(NodeRegistry& registry);
void register_principled_nodes(NodeRegistry& registry);
void register_principled_hair(NodeRegistry& registry);
void register_volume_nodes(NodeRegistry& registry);
void register_bump_nodes(NodeRegistry& registry);
void register_aov_nodes(NodeRegistry& registry);
void register_output_nodes(NodeRegistry& registry);

}  // namespace tenniel
