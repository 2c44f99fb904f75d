// The bond network in the order of the explicit step: particles cut into fixed blocks that fit a core's
// cache, bonds stored block by block. Made from Network, which stays the truth; what breaks there is
// rebuilt here. Knows geometry only.
//
// Inside a block a bond is one of two kinds:
//   twin   both ends in the block and zeta_pi = -zeta_ip, as of every bond that is not on a surface:
//          stored once, at its first end
//   half   seen from one end that the block owns; the other may be foreign. A bond that is no twin
//          has two halves, one at each end
// Local particle numbers: own particles first, in the order of the blocks, then foreign ones.
#pragma once

#include <cstdint>
#include <vector>

#include "core/bisection.hpp"
#include "core/thread_team.hpp"
#include "formulation/cbm/network.hpp"

namespace cleave::cbm {

// Bonds of one kind, in rows of own particles. After bonds broke there may be gaps between rows, and rows
// need not follow each other.
struct BlockBonds {
  std::vector<std::int32_t> begin;   // (own) first bond of a row
  std::vector<std::uint16_t> count;  // (own) bonds of a row
  std::vector<std::uint16_t> end;    // (k)   local number of the other end
  std::vector<double> zeta;          // (D,k) and padding, so that vectors of four may be loaded
  std::vector<double> weight;        // (k)   zeta_ip . X_ip [m3]; with viscosity only
  std::vector<float> square_limit;  // (k)   below the square of the length at which the bond breaks
                                    //       [m2]; with fracture only

  // Bonds and gaps.
  std::int64_t size() const { return static_cast<std::int64_t>(end.size()); }
};

struct Block {
  std::int32_t first = 0, own = 0;    // own particles: places first ... first+own-1
  std::int32_t surface = 0;           // the first of them have bonds into other blocks
  std::vector<std::int32_t> foreign;  // places of foreign particles, ascending
  std::int64_t slot = 0;              // of the first foreign particle, see BlockNetwork
  BlockBonds twins, halves;
  std::vector<std::int32_t> beside;  // blocks that own the foreign particles

  std::int32_t locals() const { return own + static_cast<std::int32_t>(foreign.size()); }
};

class BlockNetwork {
 public:
  // False if a block has more particles around it than local numbers reach.
  bool build(const Body& body, const Network& network, bool with_weights, bool with_limits,
             ThreadTeam& team);
  // A bond of a particle: the other end's local number, its position in the row of the network.
  struct Entry {
    std::int32_t local, position;
  };
  // Scratch of the functions below.
  struct Workspace {
    std::vector<Entry> row;
    std::vector<double> zeta, back;  // (3,row)
    BlockBonds twins, halves, together;
  };
  void reserve(Workspace& work, const Network& network) const;
  // All rows of the block from the network.
  void rebuild(const Network& network, Block& block, Workspace& work) const;
  // One row of it. The work is that of a row, as long as the memory for halves lasts; then rows are moved
  // together first.
  void rebuild_row(const Network& network, Block& block, std::int32_t local, Workspace& work) const;

  // Of the particle at a place.
  std::int32_t block_of(std::int32_t p) const { return block_of_[static_cast<std::size_t>(p)]; }
  std::int64_t bytes() const;

  std::vector<std::int32_t> given;  // (n) number of the particle at a place
  std::vector<std::int32_t> place;  // (n) and the other way round
  std::vector<Block> blocks;
  std::int32_t largest = 0;   // locals() of the largest block
  std::int32_t most_own = 0;  // particles of a block
  // What a block adds to a foreign particle stands in the slot of the two. Slots of every surface
  // particle, in the order of blocks: incoming[incoming_begin[place] ...].
  std::int64_t slots = 0;
  std::vector<std::int32_t> incoming_begin, incoming;

 private:
  void order_particles(const Body& body, const Network& network);
  void find_foreign(const Network& network, Block& block) const;
  void form_rows(const Network& network, const Block& block, Workspace& work) const;
  void make_row(const Network& network, const Block& block, std::int32_t local,
                Workspace& work) const;
  void put_row(int dimension, std::int32_t local, const BlockBonds& row, BlockBonds& bonds) const;
  void move_together(int dimension, BlockBonds& bonds, BlockBonds& scratch) const;
  void collect_incoming();

  bool with_weights_ = false, with_limits_ = false;
  std::vector<std::int32_t> block_of_;  // (n) of a place
};

}  // namespace cleave::cbm
