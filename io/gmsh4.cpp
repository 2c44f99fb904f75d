// Gmsh MSH 4.1: entities, nodes and elements. Nodes and elements come in blocks of an entity; the
// physical groups belong to the entities.
#include <array>

#include "io/gmsh.hpp"

namespace cleave::io::gmsh {
namespace {

std::vector<std::int64_t> read_tags(File& file, const char* what) {
  MeshBytes& bytes = file.bytes;
  const std::int64_t count = bytes.size();
  constexpr std::size_t kTextTag = 2, kBinaryTag = 4;
  bytes.check_count(count, bytes.binary() ? kBinaryTag : kTextTag, what);
  std::vector<std::int64_t> tags(static_cast<std::size_t>(count));
  for (std::int64_t& tag : tags) tag = bytes.integer();
  return tags;
}

std::array<std::int64_t, 4> read_entity_counts(File& file) {
  std::array<std::int64_t, 4> counts{};  // points, curves, surfaces, volumes
  constexpr std::size_t kTextEntity = 8, kBinaryEntity = 28;
  for (std::int64_t& count : counts) {
    count = file.bytes.size();
    file.bytes.check_count(count, file.bytes.binary() ? kBinaryEntity : kTextEntity, "entities");
  }
  return counts;
}

// Place (a point) or bounding box, physical tags, bounding entities.
std::vector<std::int64_t> read_entity_rest(File& file, int dimension) {
  const int coordinates = dimension == 0 ? 3 : 6;
  for (int k = 0; k < coordinates; ++k) file.bytes.real();
  std::vector<std::int64_t> physicals = read_tags(file, "physical tags");
  if (dimension > 0) read_tags(file, "bounding entities");
  return physicals;
}

int read_dimension(File& file) {
  const std::int64_t dimension = file.bytes.integer();
  if (dimension < 0 || dimension > 3)
    file.bytes.fail("the dimension of an entity is 0 to 3, not " + std::to_string(dimension));
  return static_cast<int>(dimension);
}

std::int64_t read_node_block(File& file, std::int64_t left) {
  MeshBytes& bytes = file.bytes;
  const int dimension = read_dimension(file);
  bytes.integer();  // entity
  const std::int64_t parametric = bytes.integer();
  if (parametric != 0 && parametric != 1)
    bytes.fail("the mark for parametric coordinates should be 0 or 1, but is " +
               std::to_string(parametric));
  const std::int64_t count = bytes.size();
  if (count < 0 || count > left)
    bytes.fail("a block of " + std::to_string(count) + " nodes, where " + std::to_string(left) +
               " are left of the number at the beginning of the section");
  constexpr std::size_t kTextNode = 8, kBinaryNode = 28;  // "1\n" and "0 0 0\n"
  bytes.check_count(count, bytes.binary() ? kBinaryNode : kTextNode, "nodes");
  std::vector<std::int64_t>& ids = file.builder.point_ids();
  std::vector<double>& points = file.builder.points();
  for (std::int64_t i = 0; i < count; ++i) ids.push_back(checked_node_number(file, bytes.size()));
  for (std::int64_t i = 0; i < count; ++i) {
    for (int k = 0; k < 3; ++k) points.push_back(bytes.real());
    for (int k = 0; k < (parametric == 1 ? dimension : 0); ++k) bytes.real();
  }
  return count;
}

std::int64_t read_element_block(File& file, std::int64_t left) {
  MeshBytes& bytes = file.bytes;
  const int dimension = read_dimension(file);
  const std::int64_t entity = bytes.integer();
  const ElementType& type = element_type(file, bytes.integer());
  if (type.dimension != dimension)
    bytes.fail(std::string("elements of kind ") + type.name + " on an entity of dimension " +
               std::to_string(dimension));
  const std::int64_t count = bytes.size();
  if (count < 0 || count > left)
    bytes.fail("a block of " + std::to_string(count) + " elements, where " + std::to_string(left) +
               " are left of the number at the beginning of the section");

  std::vector<MeshBuilder::Group> groups;
  const auto physicals = file.entity_physicals.find({dimension, entity});
  if (physicals != file.entity_physicals.end())
    for (const std::int64_t tag : physicals->second)
      groups.push_back(physical_group(file, dimension, tag));
  expect_elements(file, type, count);
  for (std::int64_t i = 0; i < count; ++i) {
    const std::int64_t number = bytes.size();
    const std::int64_t index = read_element(file, type, number);
    for (const MeshBuilder::Group group : groups) add_to_group(file, group, type, index);
  }
  return count;
}

}  // namespace

void read_entities_4(File& file) {
  const std::array<std::int64_t, 4> counts = read_entity_counts(file);
  for (int dimension = 0; dimension < 4; ++dimension)
    for (std::int64_t i = 0; i < counts[static_cast<std::size_t>(dimension)]; ++i) {
      const std::int64_t tag = file.bytes.integer();
      file.entity_physicals[{dimension, tag}] = read_entity_rest(file, dimension);
    }
}

// In a partitioned file the elements belong to these entities, which carry the physical tags of
// their parents.
void read_partitioned_entities_4(File& file) {
  MeshBytes& bytes = file.bytes;
  bytes.size();  // partitions
  const std::int64_t ghosts = bytes.size();
  constexpr std::size_t kTextGhost = 4, kBinaryGhost = 8;
  bytes.check_count(ghosts, bytes.binary() ? kBinaryGhost : kTextGhost, "ghost entities");
  for (std::int64_t i = 0; i < 2 * ghosts; ++i) bytes.integer();

  const std::array<std::int64_t, 4> counts = read_entity_counts(file);
  file.entity_physicals.clear();
  for (int dimension = 0; dimension < 4; ++dimension)
    for (std::int64_t i = 0; i < counts[static_cast<std::size_t>(dimension)]; ++i) {
      const std::int64_t tag = bytes.integer();
      const std::int64_t parent_dimension = bytes.integer();
      bytes.integer();  // parent
      read_tags(file, "partitions");
      std::vector<std::int64_t> physicals = read_entity_rest(file, dimension);
      // An interface between partitions is in no group: the tags are those of the body it cuts.
      if (parent_dimension == dimension)
        file.entity_physicals[{dimension, tag}] = std::move(physicals);
    }
}

void read_nodes_4(File& file) {
  MeshBytes& bytes = file.bytes;
  const std::int64_t blocks = bytes.size();
  const std::int64_t count = bytes.size();
  bytes.size();  // smallest and
  bytes.size();  // largest number
  constexpr std::size_t kTextNode = 8, kBinaryNode = 28;
  bytes.check_count(count, bytes.binary() ? kBinaryNode : kTextNode, "nodes");
  const auto before = file.builder.point_ids().size();
  file.builder.point_ids().reserve(before + static_cast<std::size_t>(count));
  file.builder.points().reserve(3 * (before + static_cast<std::size_t>(count)));
  std::int64_t done = 0;
  for (std::int64_t block = 0; block < blocks; ++block) done += read_node_block(file, count - done);
  if (done != count)
    bytes.fail("section $Nodes announces " + std::to_string(count) + " nodes, its blocks hold " +
               std::to_string(done));
}

void read_elements_4(File& file) {
  MeshBytes& bytes = file.bytes;
  const std::int64_t blocks = bytes.size();
  const std::int64_t count = bytes.size();
  bytes.size();                                                // smallest and
  bytes.size();                                                // largest number
  constexpr std::size_t kTextElement = 4, kBinaryElement = 8;  // "1 1\n"
  bytes.check_count(count, bytes.binary() ? kBinaryElement : kTextElement, "elements");
  std::int64_t done = 0;
  for (std::int64_t block = 0; block < blocks; ++block)
    done += read_element_block(file, count - done);
  if (done != count)
    bytes.fail("section $Elements announces " + std::to_string(count) +
               " elements, its blocks hold " + std::to_string(done));
}

}  // namespace cleave::io::gmsh
