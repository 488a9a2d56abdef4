#include "sundials_peers.hpp"

#include "bristle/dynamics/ode.hpp"

#include <arkode/arkode_arkstep.h>
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <algorithm>
#include <stdexcept>

namespace bristle::bench {
namespace {

constexpr double kMaxTime = 1000;  // in r0/V0; longer than any passage

struct Problem {
  const PassageTask* task;
  double x_0;
};

int slope(realtype, N_Vector y, N_Vector dydt, void* data) {
  const auto* in = reinterpret_cast<const OdeState*>(N_VGetArrayPointer(y));
  auto* out = reinterpret_cast<OdeState*>(N_VGetArrayPointer(dydt));
  derivative<double>(static_cast<Problem*>(data)->task->bristle, *in, *out);
  return 0;
}

int remaining_slip(realtype t, N_Vector y, realtype* g, void* data) {
  const auto* problem = static_cast<Problem*>(data);
  *g = problem->task->parameters->L_x - (t - (N_VGetArrayPointer(y)[component::X] - problem->x_0));
  return 0;
}

// solve(context, y, problem) integrates y and returns the time of the exit.
template <class Solver>
std::vector<Passage> run(const std::vector<PassageTask>& tasks, Solver solve) {
  SUNContext context;
  SUNContext_Create(nullptr, &context);
  N_Vector y = N_VNew_Serial(COMPONENTS, context);
  std::vector<Passage> out;
  for (const PassageTask& task : tasks) {
    const OdeState start = pack(state_at_rest(task.bristle, task.start));
    std::copy(start.begin(), start.end(), N_VGetArrayPointer(y));
    Problem problem{&task, start[component::X]};
    Passage& passage = out.emplace_back();
    passage.contact_time = solve(context, y, problem);
    std::copy_n(N_VGetArrayPointer(y), COMPONENTS, passage.end.begin());
    passage.outcome = Outcome::left;
  }
  N_VDestroy(y);
  SUNContext_Free(&context);
  return out;
}

}  // namespace

std::vector<Passage> run_cvode(const std::vector<PassageTask>& tasks) {
  return run(tasks, [](SUNContext context, N_Vector y, Problem& problem) {
    void* memory = CVodeCreate(CV_BDF, context);
    CVodeInit(memory, slope, 0, y);
    CVodeSStolerances(memory, problem.task->integrator.rtol, problem.task->integrator.atol);
    CVodeSetUserData(memory, &problem);
    CVodeSetMaxNumSteps(memory, -1);
    SUNMatrix matrix = SUNDenseMatrix(COMPONENTS, COMPONENTS, context);
    SUNLinearSolver solver = SUNLinSol_Dense(y, matrix, context);
    CVodeSetLinearSolver(memory, solver, matrix);
    CVodeRootInit(memory, 1, remaining_slip);
    double t = 0;
    if (CVode(memory, kMaxTime, y, &t, CV_NORMAL) != CV_ROOT_RETURN)
      throw std::runtime_error("CVODE found no exit");
    SUNLinSolFree(solver);
    SUNMatDestroy(matrix);
    CVodeFree(&memory);
    return t;
  });
}

std::vector<Passage> run_arkode(const std::vector<PassageTask>& tasks) {
  return run(tasks, [](SUNContext context, N_Vector y, Problem& problem) {
    void* memory = ARKStepCreate(slope, nullptr, 0, y, context);
    ARKStepSStolerances(memory, problem.task->integrator.rtol, problem.task->integrator.atol);
    ARKStepSetUserData(memory, &problem);
    ARKStepSetTableNum(memory, ARKODE_DIRK_NONE, ARKODE_DORMAND_PRINCE_7_4_5);
    ARKStepSetMaxNumSteps(memory, -1);
    ARKStepRootInit(memory, 1, remaining_slip);
    double t = 0;
    if (ARKStepEvolve(memory, kMaxTime, y, &t, ARK_NORMAL) != ARK_ROOT_RETURN)
      throw std::runtime_error("ARKODE found no exit");
    ARKStepFree(&memory);
    return t;
  });
}

}  // namespace bristle::bench
