#include "formulation/cbm/block_network.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cleave::cbm {

namespace {

// The pass over a block's bonds and the stress stay in a core's cache up to this size; small bodies get
// smaller blocks, so that there are enough of them for a few threads.
constexpr std::int64_t kBlockParticles = 2048, kSmallBlock = 64, kFewBlocks = 16;

std::int64_t number_of_blocks(std::int64_t n) {
  const std::int64_t by_size = (n + kBlockParticles - 1) / kBlockParticles;
  return std::max<std::int64_t>({1, by_size, std::min(kFewBlocks, n / kSmallBlock)});
}

// zeta_ip + zeta_pi of an inner bond is the rounding of two sums of a few terms, that of a bond on a surface
// the area of a facet.
constexpr double kTwin = 1e-13;

// After the last bond vector, so that four numbers may be loaded at each.
constexpr std::size_t kPadding = 4;

std::size_t at(std::int64_t k) { return static_cast<std::size_t>(k); }

bool is_zero(const double* zeta, int dimension) {
  for (int k = 0; k < dimension; ++k)
    if (zeta[k] != 0) return false;
  return true;
}

bool is_twin(const double* zeta, const double* back, int dimension) {
  double largest = 0, off = 0;
  for (int k = 0; k < dimension; ++k) {
    largest = std::fmax(largest, std::fabs(zeta[k]));
    off = std::fmax(off, std::fabs(zeta[k] + back[k]));
  }
  return off <= kTwin * largest;
}

// A little below the square of the length at which a bond breaks; 0 where that is no number of this
// precision, so that the bond itself is asked.
float limit_of(const Network& network, std::int32_t i, std::int32_t p) {
  const double limit = (1 + network.critical[network.find_bond(i, p)]) * network.length(i, p);
  const double square = limit * limit * (1 - 1e-7);
  if (!(square < std::numeric_limits<double>::infinity()))
    return std::numeric_limits<float>::infinity();
  if (!(square < std::numeric_limits<float>::max()) || square < std::numeric_limits<float>::min())
    return 0;
  return std::nextafter(static_cast<float>(square), 0.0F);
}

void clear(BlockBonds& bonds) {
  bonds.begin.clear();
  bonds.count.clear();
  bonds.end.clear();
  bonds.zeta.clear();
  bonds.weight.clear();
  bonds.square_limit.clear();
}

template <class T>
void fit(std::vector<T>& list, std::int64_t capacity) {
  list.shrink_to_fit();
  list.reserve(at(capacity));
}
void fit(BlockBonds& bonds, int dimension, std::int64_t capacity, bool weights, bool limits) {
  fit(bonds.end, capacity);
  fit(bonds.zeta, dimension * capacity + kPadding);
  fit(bonds.weight, weights ? capacity : 0);
  fit(bonds.square_limit, limits ? capacity : 0);
}

template <class T>
void append(const std::vector<T>& from, std::int64_t first, std::int64_t last, std::vector<T>& to) {
  if (!from.empty()) to.insert(to.end(), from.begin() + first, from.begin() + last);
}

void pad(BlockBonds& bonds) { bonds.zeta.resize(bonds.zeta.size() + kPadding, 0.0); }
void unpad(BlockBonds& bonds) { bonds.zeta.resize(bonds.zeta.size() - kPadding); }

std::int64_t bytes_of(const BlockBonds& b) {
  return static_cast<std::int64_t>(b.begin.size() * sizeof(std::int32_t) +
                                   (b.end.size() + b.count.size()) * sizeof(std::uint16_t) +
                                   b.square_limit.size() * sizeof(float) +
                                   (b.zeta.size() + b.weight.size()) * sizeof(double));
}

}  // namespace

void BlockNetwork::order_particles(const Body& body, const Network& network) {
  const std::int64_t n = body.particles;
  Blocking cut = bisect(body.point.X, n, body.dimension(), number_of_blocks(n));
  given = std::move(cut.order);
  block_of_.assign(at(n), 0);
  blocks.assign(at(cut.blocks()), {});
  std::vector<std::int32_t> owner(at(n));
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    blocks[b].first = cut.begin[b];
    blocks[b].own = cut.begin[b + 1] - cut.begin[b];
    for (std::int32_t p = cut.begin[b]; p < cut.begin[b + 1]; ++p) {
      block_of_[at(p)] = static_cast<std::int32_t>(b);
      owner[at(given[at(p)])] = static_cast<std::int32_t>(b);
    }
  }
  for (Block& block : blocks) {
    const auto on_surface = [&](std::int32_t i) {
      for (const std::int32_t p : network.neighbours(i))
        if (owner[at(p)] != owner[at(i)]) return true;
      return false;
    };
    const auto first = given.begin() + block.first;
    block.surface = static_cast<std::int32_t>(
        std::stable_partition(first, first + block.own, on_surface) - first);
  }
  place.resize(at(n));
  for (std::int64_t p = 0; p < n; ++p) place[at(given[at(p)])] = static_cast<std::int32_t>(p);
}

void BlockNetwork::find_foreign(const Network& network, Block& block) const {
  block.foreign.clear();
  for (std::int32_t p = block.first; p < block.first + block.surface; ++p) {
    for (const std::int32_t other : network.neighbours(given[at(p)])) {
      const std::int32_t q = place[at(other)];
      if (q < block.first || q >= block.first + block.own) block.foreign.push_back(q);
    }
  }
  std::sort(block.foreign.begin(), block.foreign.end());
  block.foreign.erase(std::unique(block.foreign.begin(), block.foreign.end()), block.foreign.end());
  block.foreign.shrink_to_fit();
  block.beside.clear();
  for (const std::int32_t q : block.foreign) block.beside.push_back(block_of(q));
  std::sort(block.beside.begin(), block.beside.end());
  block.beside.erase(std::unique(block.beside.begin(), block.beside.end()), block.beside.end());
}

void BlockNetwork::collect_incoming() {
  slots = 0;
  incoming_begin.assign(place.size() + 1, 0);
  for (Block& block : blocks) {
    block.slot = slots;
    slots += static_cast<std::int64_t>(block.foreign.size());
    for (const std::int32_t q : block.foreign) ++incoming_begin[at(q) + 1];
  }
  for (std::size_t p = 1; p < incoming_begin.size(); ++p)
    incoming_begin[p] += incoming_begin[p - 1];
  incoming.resize(at(slots));
  std::vector<std::int32_t> next(incoming_begin.begin(), incoming_begin.end() - 1);
  for (const Block& block : blocks) {
    for (std::size_t k = 0; k < block.foreign.size(); ++k) {
      incoming[at(next[at(block.foreign[k])]++)] =
          static_cast<std::int32_t>(block.slot + static_cast<std::int64_t>(k));
    }
  }
}

// Appends to work.twins and work.halves.
void BlockNetwork::make_row(const Network& network, const Block& block, std::int32_t l,
                            Workspace& work) const {
  const int dimension = network.dimension;
  const std::int32_t i = given[at(block.first + l)];
  const std::span<const std::int32_t> neighbours = network.neighbours(i);
  const auto local = [&](std::int32_t q) {
    if (q >= block.first && q < block.first + block.own) return q - block.first;
    const auto found = std::lower_bound(block.foreign.begin(), block.foreign.end(), q);
    return block.own + static_cast<std::int32_t>(found - block.foreign.begin());
  };
  const auto add = [&](BlockBonds& bonds, const Entry& e, const double* zeta) {
    const std::int32_t p = neighbours[at(e.position)];
    bonds.end.push_back(static_cast<std::uint16_t>(e.local));
    bonds.zeta.insert(bonds.zeta.end(), zeta, zeta + dimension);
    if (with_weights_) bonds.weight.push_back(network.weight(i, p, zeta));
    if (with_limits_) bonds.square_limit.push_back(limit_of(network, i, p));
  };
  dimension == 2 ? network.form_row<2>(i, work.zeta.data(), work.back.data())
                 : network.form_row<3>(i, work.zeta.data(), work.back.data());
  std::vector<Entry>& row = work.row;
  row.clear();
  for (std::size_t k = 0; k < neighbours.size(); ++k)
    row.push_back({local(place[at(neighbours[k])]), static_cast<std::int32_t>(k)});
  std::sort(row.begin(), row.end(),
            [](const Entry& a, const Entry& b) { return a.local < b.local; });
  for (const Entry& e : row) {
    const double* zeta = work.zeta.data() + kVector * e.position;
    const double* back = work.back.data() + kVector * e.position;
    if (is_zero(zeta, dimension)) continue;  // no live simplex left
    if (e.local < block.own && is_twin(zeta, back, dimension)) {
      if (e.local > l) add(work.twins, e, zeta);
    } else {
      add(work.halves, e, zeta);
    }
  }
}

void BlockNetwork::form_rows(const Network& network, const Block& block, Workspace& work) const {
  clear(work.twins);
  clear(work.halves);
  for (std::int32_t l = 0; l < block.own; ++l) {
    for (BlockBonds* bonds : {&work.twins, &work.halves})
      bonds->begin.push_back(static_cast<std::int32_t>(bonds->size()));
    make_row(network, block, l, work);
    for (BlockBonds* bonds : {&work.twins, &work.halves})
      bonds->count.push_back(static_cast<std::uint16_t>(bonds->size() - bonds->begin.back()));
  }
  for (BlockBonds* bonds : {&work.twins, &work.halves}) pad(*bonds);
}

// Copied, not swapped: a block keeps the memory that was reserved for it.
void BlockNetwork::rebuild(const Network& network, Block& block, Workspace& work) const {
  form_rows(network, block, work);
  block.twins = work.twins;
  block.halves = work.halves;
}

// A row that grew goes to the end.
void BlockNetwork::put_row(int dimension, std::int32_t l, const BlockBonds& row,
                           BlockBonds& bonds) const {
  const auto overwrite = [&](const auto& from, auto& to, std::int64_t components) {
    std::copy(from.begin(), from.end(), to.begin() + components * bonds.begin[at(l)]);
  };
  if (row.size() <= bonds.count[at(l)]) {
    overwrite(row.end, bonds.end, 1);
    overwrite(row.zeta, bonds.zeta, dimension);
    overwrite(row.weight, bonds.weight, 1);
    overwrite(row.square_limit, bonds.square_limit, 1);
  } else {
    unpad(bonds);
    bonds.begin[at(l)] = static_cast<std::int32_t>(bonds.size());
    append(row.end, 0, row.size(), bonds.end);
    append(row.zeta, 0, dimension * row.size(), bonds.zeta);
    append(row.weight, 0, row.size(), bonds.weight);
    append(row.square_limit, 0, row.size(), bonds.square_limit);
    pad(bonds);
  }
  bonds.count[at(l)] = static_cast<std::uint16_t>(row.size());
}

void BlockNetwork::move_together(int dimension, BlockBonds& bonds, BlockBonds& scratch) const {
  clear(scratch);
  for (std::size_t l = 0; l < bonds.begin.size(); ++l) {
    const std::int64_t first = bonds.begin[l], last = first + bonds.count[l];
    scratch.begin.push_back(static_cast<std::int32_t>(scratch.size()));
    scratch.count.push_back(bonds.count[l]);
    append(bonds.end, first, last, scratch.end);
    append(bonds.zeta, dimension * first, dimension * last, scratch.zeta);
    append(bonds.weight, first, last, scratch.weight);
    append(bonds.square_limit, first, last, scratch.square_limit);
  }
  pad(scratch);
  bonds = scratch;
}

void BlockNetwork::rebuild_row(const Network& network, Block& block, std::int32_t l,
                               Workspace& work) const {
  clear(work.twins);
  clear(work.halves);
  make_row(network, block, l, work);
  for (const auto& [row, bonds] :
       {std::pair{&work.twins, &block.twins}, std::pair{&work.halves, &block.halves}}) {
    const bool grows = row->size() > bonds->count[at(l)];
    if (grows && at(bonds->size() + row->size()) > bonds->end.capacity()) {
      move_together(network.dimension, *bonds, work.together);
    }
    put_row(network.dimension, l, *row, *bonds);
  }
}

// Every bond a half at both ends.
void BlockNetwork::reserve(Workspace& work, const Network& network) const {
  const std::int32_t row = network.longest_row();
  std::int64_t bonds = 0;
  for (const Block& block : blocks)
    bonds = std::max(bonds, 2 * block.twins.size() + block.halves.size());
  work.row.reserve(at(row));
  work.zeta.resize(kVector * at(row));
  work.back.resize(kVector * at(row));
  for (BlockBonds* b : {&work.twins, &work.halves})
    fit(*b, network.dimension, row, with_weights_, with_limits_);
  if (!with_limits_) return;
  work.together.begin.reserve(at(most_own));
  work.together.count.reserve(at(most_own));
  fit(work.together, network.dimension, bonds, with_weights_, with_limits_);
}

bool BlockNetwork::build(const Body& body, const Network& network, bool with_weights,
                         bool with_limits, ThreadTeam& team) {
  with_weights_ = with_weights;
  with_limits_ = with_limits;
  order_particles(body, network);
  team.for_blocks(static_cast<std::int64_t>(blocks.size()),
                  [&](std::int64_t b) { find_foreign(network, blocks[at(b)]); });
  largest = most_own = 0;
  for (const Block& block : blocks) {
    largest = std::max(largest, block.locals());
    most_own = std::max(most_own, block.own);
  }
  if (largest > std::numeric_limits<std::uint16_t>::max()) return false;
  collect_incoming();
  const auto row = at(kVector * static_cast<std::int64_t>(network.longest_row()));
  std::vector<Workspace> workspaces(at(team.size()));
  team.for_blocks(static_cast<std::int64_t>(blocks.size()), [&](std::int64_t b, int worker) {
    Block& block = blocks[at(b)];
    Workspace& work = workspaces[at(worker)];
    work.zeta.resize(row);
    work.back.resize(row);
    form_rows(network, block, work);
    // A twin that breaks open becomes two halves. What is reserved and was never used costs no memory.
    const std::int64_t halves = work.halves.size() + (with_limits ? 2 * work.twins.size() : 0);
    fit(block.twins, body.dimension(), work.twins.size(), with_weights, with_limits);
    fit(block.halves, body.dimension(), halves, with_weights, with_limits);
    block.twins = work.twins;
    block.halves = work.halves;
  });
  return true;
}

std::int64_t BlockNetwork::bytes() const {
  std::int64_t sum =
      static_cast<std::int64_t>((given.capacity() + place.capacity() + block_of_.capacity() +
                                 incoming_begin.capacity() + incoming.capacity()) *
                                sizeof(std::int32_t));
  for (const Block& block : blocks) {
    sum += static_cast<std::int64_t>((block.foreign.capacity() + block.beside.capacity()) *
                                     sizeof(std::int32_t)) +
           bytes_of(block.twins) + bytes_of(block.halves);
  }
  return sum;
}

}  // namespace cleave::cbm
