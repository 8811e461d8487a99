// All differences between SUNDIALS 6.4 (Debian's) and 7.x, so that no other file asks for the version.
#pragma once

#include <cstdio>  // arkode_butcher.h uses FILE and does not include it
#include <stdexcept>
#include <string>

#include <arkode/arkode_butcher_erk.h>
#include <arkode/arkode_erkstep.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_config.h>

#define STILLPOINT_SUNDIALS_AT_LEAST(major, minor) \
  (SUNDIALS_VERSION_MAJOR > (major) || (SUNDIALS_VERSION_MAJOR == (major) && SUNDIALS_VERSION_MINOR >= (minor)))

namespace stillpoint::sundials {

/// A context without MPI; 6.x takes a pointer to the communicator, 7.x the communicator itself.
inline SUNContext create_context() {
  SUNContext context = nullptr;
#if STILLPOINT_SUNDIALS_AT_LEAST(7, 0)
  const auto code = SUNContext_Create(SUN_COMM_NULL, &context);
#else
  const auto code = SUNContext_Create(nullptr, &context);
#endif
  if (code != 0) throw std::runtime_error("SUNDIALS cannot make a context");
  return context;
}

// ERKStepXxx became ARKodeXxx in 7.1; only functions that are specific to ERKStep kept their names.
#if STILLPOINT_SUNDIALS_AT_LEAST(7, 1)
#define STILLPOINT_ARKODE(name) inline constexpr auto name = &ARKode##name
#else
#define STILLPOINT_ARKODE(name) inline constexpr auto name = &ERKStep##name
#endif
STILLPOINT_ARKODE(Evolve);
STILLPOINT_ARKODE(Free);
STILLPOINT_ARKODE(GetCurrentStep);
STILLPOINT_ARKODE(GetLastStep);
STILLPOINT_ARKODE(GetNumErrTestFails);
STILLPOINT_ARKODE(GetReturnFlagName);
STILLPOINT_ARKODE(Reset);
STILLPOINT_ARKODE(RootInit);
STILLPOINT_ARKODE(SVtolerances);
STILLPOINT_ARKODE(SetFixedStep);
STILLPOINT_ARKODE(SetInitStep);
STILLPOINT_ARKODE(SetInterpolantDegree);
STILLPOINT_ARKODE(SetInterpolantType);
STILLPOINT_ARKODE(SetMaxNumSteps);
STILLPOINT_ARKODE(SetMaxStep);
STILLPOINT_ARKODE(SetPostprocessStepFn);
STILLPOINT_ARKODE(SetRootDirection);
STILLPOINT_ARKODE(SetStopTime);
STILLPOINT_ARKODE(SetUserData);
STILLPOINT_ARKODE(WFtolerances);
#undef STILLPOINT_ARKODE

/// Before 6.7 ERKStep takes every table with c_s = 1 for first-same-as-last and reuses the wrong f (issue 311).
inline constexpr bool reuses_last_stage_wrongly = !STILLPOINT_SUNDIALS_AT_LEAST(6, 7);

/// Selects the cheapest dense output, as this library never asks for any. Before 7.1 it cannot be switched off, and a
/// Lagrange interpolant of degree 0 (one copy of y a step) is the cheapest.
inline int set_cheapest_interpolant(void* arkode) {
#if STILLPOINT_SUNDIALS_AT_LEAST(7, 1)
  return SetInterpolantType(arkode, ARK_INTERP_NONE);
#else
  const int code = SetInterpolantType(arkode, ARK_INTERP_LAGRANGE);
  return code == 0 ? SetInterpolantDegree(arkode, 0) : code;
#endif
}

/// Selects cubic dense output from the values and derivatives at both ends, for events that are located inside a step.
inline int set_hermite_interpolant(void* arkode) {
  const int code = SetInterpolantType(arkode, ARK_INTERP_HERMITE);
  return code == 0 ? SetInterpolantDegree(arkode, 3) : code;
}

/// Keeps SUNDIALS' last message in `last` instead of printing it; `last` has to outlive the integrator.
#if STILLPOINT_SUNDIALS_AT_LEAST(7, 0)
inline int capture_messages(void* /*arkode*/, SUNContext context, std::string& last) {
  SUNContext_ClearErrHandlers(context);
  return SUNContext_PushErrHandler(
      context,
      [](int, const char*, const char*, const char* message, SUNErrCode, void* to, SUNContext) {
        if (message) *static_cast<std::string*>(to) = message;
      },
      &last);
}
/// Ends capture_messages(): messages are dropped.
inline void release_messages(SUNContext context) { SUNContext_ClearErrHandlers(context); }
#else
inline int capture_messages(void* arkode, SUNContext /*context*/, std::string& last) {
  return ERKStepSetErrHandlerFn(
      arkode,
      [](int, const char*, const char*, char* message, void* to) {
        if (message) *static_cast<std::string*>(to) = message;
      },
      &last);
}
inline void release_messages(SUNContext /*context*/) {}
#endif

/// The name of one of ARKODE's explicit tables, as in its enumeration; empty if it is unknown.
inline std::string table_name(int id) {
#if STILLPOINT_SUNDIALS_AT_LEAST(7, 1)
  const char* name = ARKodeButcherTable_ERKIDToName(static_cast<ARKODE_ERKTableID>(id));
  return name ? name : "";
#else
  // 6.x has no function for the name; the enumeration only ever grows at its end.
  static const char* const names[] = {"ARKODE_HEUN_EULER_2_1_2",
                                      "ARKODE_BOGACKI_SHAMPINE_4_2_3",
                                      "ARKODE_ARK324L2SA_ERK_4_2_3",
                                      "ARKODE_ZONNEVELD_5_3_4",
                                      "ARKODE_ARK436L2SA_ERK_6_3_4",
                                      "ARKODE_SAYFY_ABURUB_6_3_4",
                                      "ARKODE_CASH_KARP_6_4_5",
                                      "ARKODE_FEHLBERG_6_4_5",
                                      "ARKODE_DORMAND_PRINCE_7_4_5",
                                      "ARKODE_ARK548L2SA_ERK_8_4_5",
                                      "ARKODE_VERNER_8_5_6",
                                      "ARKODE_FEHLBERG_13_7_8",
                                      "ARKODE_KNOTH_WOLKE_3_3",
                                      "ARKODE_ARK437L2SA_ERK_7_3_4",
                                      "ARKODE_ARK548L2SAb_ERK_8_4_5",
                                      "ARKODE_ARK2_ERK_3_1_2",
                                      "ARKODE_SOFRONIOU_SPALETTA_5_3_4",
                                      "ARKODE_SHU_OSHER_3_2_3",
                                      "ARKODE_VERNER_9_5_6",
                                      "ARKODE_VERNER_10_6_7",
                                      "ARKODE_VERNER_13_7_8",
                                      "ARKODE_VERNER_16_8_9"};
  constexpr int known = static_cast<int>(sizeof(names) / sizeof(names[0]));
  return id >= 0 && id < known ? names[id] : "";
#endif
}

}  // namespace stillpoint::sundials
