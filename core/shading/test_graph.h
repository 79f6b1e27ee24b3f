// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sstream>
#include <string>
#include <vector>

#include "shading/material.h"

// Shader trees as text, for tests. One node a line, words apart by blanks:
//   mix: ShaderNodeMixShader Fac=0.25 Shader<a.BSDF Shader_001<b.Emission
//   sum: ShaderNodeMath @operation=ADD Value=1,2,3
// `=` gives a value (1, 3 or 4 numbers), `<` a link, `@` a setting; `~` stands for a blank in
// names. The node "out" is the output.
namespace tenniel {

class GraphText {
 public:
  static NodeGraph parse(const std::string& text) {
    GraphText parser;
    for (const bool links : {false, true}) {
      std::istringstream lines(text);
      for (std::string line; std::getline(lines, line);)
        parser.parse_line(line, links);
    }
    return parser.graph_;
  }

 private:
  void parse_line(const std::string& line, bool links) {
    std::istringstream words(line);
    std::string name, type;
    if (!(words >> name >> type)) return;
    name.pop_back();
    if (!links) {
      if (name == "out") graph_.output = static_cast<int>(graph_.nodes.size());
      if (type == "ShaderNodeOutputAOV")
        graph_.aov_outputs.push_back(static_cast<int>(graph_.nodes.size()));
      graph_.nodes.push_back({type, name, {}, {}});
    }
    for (std::string word; words >> word;)
      parse_word(index_of(name), word, links);
  }

  uint32_t index_of(const std::string& name) const {
    uint32_t i = 0;
    while (i < graph_.nodes.size() && graph_.nodes[i].name != name)
      ++i;
    return i;
  }

  void parse_word(uint32_t node, std::string word, bool links) {
    for (char& c : word)
      if (c == '~') c = ' ';
    const size_t at = word.find_first_of("=<");
    const std::string key = word.substr(0, at), value = word.substr(at + 1);
    if (word[at] == '<') {
      const size_t dot = value.find('.');
      if (links)
        graph_.links.push_back({index_of(value.substr(0, dot)), value.substr(dot + 1), node, key});
    } else if (!links) {
      if (key[0] == '@')
        graph_.nodes[node].settings[key.substr(1)] = value;
      else
        graph_.nodes[node].inputs[key] = numbers(value);
    }
  }

  static std::vector<float> numbers(const std::string& text) {
    std::vector<float> values;
    std::istringstream in(text);
    for (std::string part; std::getline(in, part, ',');)
      values.push_back(std::stof(part));
    return values;
  }

  NodeGraph graph_;
};

// A compiled text with everything that was reported.
struct TestMaterial {
  AttributeIds attributes;
  std::vector<AovPass> aovs{{"number", false, 0}, {"color", true, 1}};
  std::vector<std::string> reports;  // "node: text"
  NodeGraph graph;
  Material material;

  explicit TestMaterial(const std::string& text, bool optimise = true,
                        const NodeRegistry* registry = nullptr)
      : TestMaterial(GraphText::parse(text), MaterialSource{}, optimise, registry) {}

  TestMaterial(NodeGraph parsed, MaterialSource source, bool optimise = true,
               const NodeRegistry* registry = nullptr)
      : graph(std::move(parsed)) {
    source.graph = &graph;
    CompileContext context;
    context.attributes = &attributes;
    context.aovs = &aovs;
    context.report = [this](const std::string& node, const std::string& text) {
      reports.push_back(node + ": " + text);
    };
    context.optimise = optimise;
    context.registry = registry;
    material = compile_material(source, context);
  }

  // Runs a program of this material at the context's surface.
  void run(const Program& program, uint8_t query, ShadingContext& context) const {
    context.reserve(program.register_count());
    context.begin(query);
    program.run(context);
    context.bsdf.finish();
  }
};

}  // namespace tenniel
