#include "run/events_file.hpp"

#include <array>

#include "deck/unit_text.hpp"

namespace cleave::driver {
namespace {

std::vector<io::Column> columns(const Scene& scene) {
  const UnitText units(scene.deck().one("run").text("units"));
  return {{"body", "1", "number of the body in the deck, from 1", true},
          {"step", "1", "step that broke the bond, from 1", true},
          {"time", units("s"), "end of that step", false},
          {"first", "1", "number of the particle at one end, as in the mesh", true},
          {"second", "1", "number of the particle at the other end, as in the mesh", true},
          {"x", units("m"), "reference position of the middle of the bond", false},
          {"y", units("m"), "reference position of the middle of the bond", false},
          {"z", units("m"), "reference position of the middle of the bond", false},
          {"criterion", "1",
           "value of the fracture criterion: bond strain, or force [N] or energy [J] of the bond",
           false},
          {"limit", "1", "critical value of the criterion", false},
          {"released", units("J"), "energy released by this bond", false}};
}

}  // namespace

void EventsFile::create(const std::string& path, const Scene& scene) {
  std::string names;
  for (const BodyGeometry& body : scene.bodies()) {
    names += (names.empty() ? "" : ",") + body.name;
  }
  table_ = io::RecordTable::create(path, "", columns(scene),
                                   {{"title", scene.deck().one("run").text("title")},
                                    {"cleave_version", cleave_version()},
                                    {"units", scene.deck().one("run").text("units")},
                                    {"bodies", names}});
}

void EventsFile::reopen(const std::string& path, const Scene& scene, std::int64_t records) {
  table_ = io::RecordTable::reopen(path, "", columns(scene), records);
}

void EventsFile::collect(const Scene& scene, Model& model, std::int64_t step) {
  for (std::int64_t body = 0; body < model.bodies(); ++body) {
    std::int64_t count = 0;
    check(cleave_body_event_count(model.handle(), body, &count));
    if (count == 0) continue;
    const auto& ids = scene.bodies()[static_cast<std::size_t>(body)].point_ids;
    for (std::int64_t i = 0; i < count; ++i) {
      cleave_event event{};
      event.size = sizeof event;
      check(cleave_body_event_get(model.handle(), body, i, &event));
      const auto id = [&](std::int64_t particle) {
        return static_cast<double>(ids[static_cast<std::size_t>(particle)]);
      };
      const std::array<double, 11> record{static_cast<double>(body + 1),
                                          static_cast<double>(step),
                                          event.time,
                                          id(event.first),
                                          id(event.second),
                                          event.midpoint[0],
                                          event.midpoint[1],
                                          event.midpoint[2],
                                          event.criterion,
                                          event.limit,
                                          event.released};
      table_->append(record);
    }
    check(cleave_body_clear_events(model.handle(), body));
  }
}

}  // namespace cleave::driver
