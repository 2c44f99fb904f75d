// Gmsh MSH 2.2: nodes and elements. Elements carry their physical and elementary tags themselves;
// one in several physical groups is written once for each.
#include "io/gmsh.hpp"

namespace cleave::io::gmsh {
namespace {

// The group of the element's first tag, remembered because runs of elements share it.
class GroupCache {
 public:
  MeshBuilder::Group find(File& file, int dimension, std::int64_t tag) {
    const EntityKey key{dimension, tag};
    if (key != key_) {
      group_ = physical_group(file, dimension, tag);
      key_ = key;
    }
    return group_;
  }

 private:
  EntityKey key_{-1, 0};
  MeshBuilder::Group group_ = 0;
};

std::int64_t read_tags(File& file, std::int64_t tags) {
  std::int64_t physical = 0;
  for (std::int64_t i = 0; i < tags; ++i) {
    const std::int64_t tag = file.bytes.integer();
    if (i == 0) physical = tag;  // then: elementary entity, partitions
  }
  return physical;
}

void read_element_2(File& file, GroupCache& groups, const ElementType& type, std::int64_t tags,
                    std::int64_t number) {
  const std::int64_t physical = read_tags(file, tags);
  const std::int64_t index = read_element(file, type, number);
  if (physical != 0) add_to_group(file, groups.find(file, type.dimension, physical), type, index);
}

// element type, elements that follow, tags of each; then the elements.
std::int64_t read_binary_run(File& file, GroupCache& groups, std::int64_t left) {
  MeshBytes& bytes = file.bytes;
  const ElementType& type = element_type(file, bytes.integer());
  const std::int64_t run = bytes.integer();
  if (run < 1 || run > left)
    bytes.fail("a block of " + std::to_string(run) + " elements, where 1 to " +
               std::to_string(left) + " are left");
  const std::int64_t tags = bytes.integer();
  bytes.check_count(tags, sizeof(std::int32_t), "tags");
  expect_elements(file, type, run);
  for (std::int64_t i = 0; i < run; ++i) {
    const std::int64_t number = bytes.integer();
    read_element_2(file, groups, type, tags, number);
  }
  return run;
}

}  // namespace

void read_nodes_2(File& file) {
  MeshBytes& bytes = file.bytes;
  const std::int64_t count = bytes.text_integer();
  bytes.line();
  constexpr std::size_t kTextNode = 8, kBinaryNode = 28;  // "1 0 0 0\n"
  bytes.check_count(count, bytes.binary() ? kBinaryNode : kTextNode, "nodes");
  std::vector<std::int64_t>& ids = file.builder.point_ids();
  std::vector<double>& points = file.builder.points();
  ids.reserve(ids.size() + static_cast<std::size_t>(count));
  points.reserve(points.size() + 3 * static_cast<std::size_t>(count));
  for (std::int64_t i = 0; i < count; ++i) {
    ids.push_back(checked_node_number(file, bytes.integer()));
    for (int k = 0; k < 3; ++k) points.push_back(bytes.real());
  }
}

void read_elements_2(File& file) {
  MeshBytes& bytes = file.bytes;
  const std::int64_t count = bytes.text_integer();
  bytes.line();
  constexpr std::size_t kTextElement = 7, kBinaryElement = 8;  // "1 15 0 1" with the shortest type
  bytes.check_count(count, bytes.binary() ? kBinaryElement : kTextElement, "elements");
  GroupCache groups;
  if (bytes.binary()) {
    for (std::int64_t done = 0; done < count;) done += read_binary_run(file, groups, count - done);
    return;
  }
  for (std::int64_t i = 0; i < count; ++i) {
    const std::int64_t number = bytes.text_integer();
    const ElementType& type = element_type(file, bytes.text_integer());
    const std::int64_t tags = bytes.text_integer();
    constexpr std::size_t kTextTag = 2;
    bytes.check_count(tags, kTextTag, "tags");
    read_element_2(file, groups, type, tags, number);
  }
}

}  // namespace cleave::io::gmsh
