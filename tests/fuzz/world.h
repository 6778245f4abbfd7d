// SPDX-License-Identifier: GPL-3.0-or-later
//
// Runs a scenario through the C API, and fails where the library breaks a promise of its header:
//
//   statuses    are those of the header; none is a defect of the library's own, or a lack of memory
//   sentences   one for every failure: not empty, ended, in one line, with a full stop
//   outputs     untouched by what fails and by what has too little room; otherwise written, and numbers
//   curves      of a mesh that is a surface as it is: what tests/sweep/curve_checker.h checks, after every call that
//               may change one
//   refusals    leave a flow that can go on
//   threads     the same flow on several threads at once gives the same bytes
//
// Memory errors, leaks and undefined behaviour are left to the sanitizers, and hangs to libFuzzer.
#pragma once

#include <meander/meander.h>

#include <memory>
#include <optional>
#include <set>
#include <string>

#include "curve_checker.h"
#include "inputs.h"
#include "outputs.h"

namespace meander::fuzz {

class World {
 public:
  explicit World(const Transcript& transcript) : transcript_(transcript), in_(transcript) {}
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  void run(const Record& record);
  /// What can still be done with every flow.
  void finish();

 private:
  /// A mesh as a surface was made of it, and what the calls for it may cost.
  struct Shape {
    std::vector<double> vertices;
    std::vector<uint32_t> faces;
    double diagonal = 0, relative_area = 0;  // in squares of the diagonal
    bool extreme = false;  // so large or small that squares of lengths are no doubles
    bool plain = false;    // a surface as it is, on which the checker can say where points are
  };
  struct SurfaceSlot {
    meander_surface* handle = nullptr;
    Shape shape;
  };
  struct FlowSlot {
    meander_flow* handle = nullptr;
    Shape shape;
    std::optional<sweep::CurveChecker> checker;
    meander_flow_options options{};  // without the tail that an older caller does not know
    bool started = false, cancellable = false, moved_on = false;
    uint32_t taken = 0;  // iterations at most
  };

  template <class Function, class... Arguments>
  meander_status call(const char* name, Function function, const Shown<Arguments>&... arguments);
  template <class Struct>
  Shown<Struct*> sized(Sized<Struct>& given, const char* name, const char* value);
  template <class Struct>
  Sized<Struct> made(StructName name, const Struct& value) const;
  void check_sentence(meander_status status);
  void check_refusal_of_cancelled(meander_status status);

  // What the flags of the record ask for.
  bool has(Flag flag) const { return (record_.flags & flag) != 0; }
  bool missing(unsigned bit) const { return (record_.f >> bit & 1) != 0; }
  size_t room_for(size_t count) const;
  SurfaceSlot& surface() { return surfaces_[has(kOther)]; }
  FlowSlot& flow() { return flows_[has(kOther)]; }
  Shown<meander_surface*> surface_handle();
  Shown<meander_flow*> flow_handle();
  Shown<meander_context*> context();
  template <class T>
  Shown<T*> out(T& value, const char* name);

  void call_surface();
  void call_flow();
  void call_getter();
  void call_cut();
  void call_context();

  void create_surface();
  void surface_statistics();
  void find_faults();
  void find_closest();
  void field_of_surface();
  void stroke_directions();
  void turn_directions();
  Shown<const char*> text(std::unique_ptr<char[]>& memory, size_t& size);
  void read_polygons();
  void read_numbers();
  void write_rows();
  void triangulate();
  void outlines();
  void create_flow();
  void run_flow();
  void start_flow();
  void wait_for_flow();
  void preview();
  void keep_growth();
  void revise_flow();
  void set_vertices();
  void set_directions();
  void flow_statistics();
  void history();
  void polylines();
  void nodes();
  void point_data();
  void gaps();
  void round_curve();
  void cut_surface();
  void places_of_cut(const Filled<meander_cut>& cut);
  void map_pixels();
  void free_functions();
  void cost();
  void several_threads();

  static Shape shape_of(std::vector<double> vertices, std::vector<uint32_t> faces);
  double radius_for(const Shape& shape) const;
  bool affordable(const Shape& shape, double radius, double segment_length) const;
  Sized<meander_flow_options> options_for(const Shape& shape);
  Sized<meander_seed> seed_struct();
  size_t vertex_count_for(const Shape& shape) const;
  bool spend(unsigned cost);
  void after_change(FlowSlot& slot, meander_status status, bool stepped);
  void begin_checks(FlowSlot& slot);
  void destroy_flow(FlowSlot& slot);
  size_t* count_pointer(size_t& count) { return has(kNoCount) ? nullptr : &count; }

  const Transcript& transcript_;
  Inputs in_;
  Record record_{};
  SurfaceSlot surfaces_[2];
  FlowSlot flows_[2];
  meander_context* context_ = nullptr;
  bool cancelled_ = false;
  Sized<meander_error> error_;
  unsigned budget_ = 30;  ///< what calls may still cost, so that a scenario takes milliseconds
};

}  // namespace meander::fuzz
