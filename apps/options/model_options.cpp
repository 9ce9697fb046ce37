// SPDX-License-Identifier: BSD-3-Clause
#include "options/model_options.h"

#include "command_line/app.h"
#include "command_line/value_checks.h"
#include "files/files.h"

namespace pcl_sq::app {

namespace {

void addFitOptions(CLI::App& cli, EstimationOptions& options) {
  addChoice<Decomposition>(
      cli,
      "--decomposition",
      options.decomposition,
      {{"none", Decomposition::NONE},
       {"prisms", Decomposition::PRISMS},
       {"parts", Decomposition::PARTS}},
      "One superquadric, one per prism of voxels, or as many as the data ask for");
  addChoice<FitMode>(
      cli,
      "--fit",
      options.fit,
      {{"paper", FitMode::PAPER}, {"full", FitMode::FULL}},
      "The paper's three parameters, the default of its chain, or all eleven");
  PaperFitOptions& fit = options.paper_fit;
  addChoice<Cost>(
      cli,
      "--cost",
      fit.cost,
      {{"paper", Cost::PAPER}, {"solina", Cost::SOLINA}, {"radial", Cost::RADIAL}},
      "What the paper's fit minimises");
  addChoice<AxisAssignment>(
      cli,
      "--axis-assignment",
      fit.axis_assignment,
      {{"depth", AxisAssignment::DEPTH}, {"best_of_3", AxisAssignment::BEST_OF_3}},
      "Axis of epsilon1: the depth, or the best of three");
  addChoice<Extents>(
      cli,
      "--extents",
      fit.extents,
      {{"extremes", Extents::EXTREMES}, {"quantiles", Extents::QUANTILES}},
      "Width and height from the outermost points or from quantiles");
  addChoice<PcaScope>(cli,
                      "--pca",
                      options.pca,
                      {{"object", PcaScope::OBJECT}, {"part", PcaScope::PART}},
                      "One rotation for all parts, or one for each");
  addChoice<CenterRule>(
      cli,
      "--center",
      options.center,
      {{"front", CenterRule::FRONT},
       {"region", CenterRule::REGION},
       {"mean", CenterRule::MEAN}},
      "A part's points keep their front, or the centre is the region's or theirs");
}

/** \brief Voxels along a side: an image of a megapixel has three points, which a voxel
 * needs, in each of so many squared. The search for prisms takes their cube. */
constexpr int MAX_DIVISIONS = 500;

void addPrismOptions(CLI::App& cli, EstimationOptions& options) {
  VoxelOptions& voxels = options.voxels;
  cli.add_option_function<std::vector<double>>(
         "--voxel-percent",
         [&voxels](const std::vector<double>& percent) {
           voxels.rule = VoxelRule::PERCENT;
           voxels.percent = Eigen::Vector3d(percent[0], percent[1], percent[2]);
         },
         "Voxel sides in percent of the region's sides")
      ->expected(3)
      ->delimiter(',')
      ->type_name("X,Y,Z")
      ->default_str("5,5,10")
      ->check(number(100.0 / MAX_DIVISIONS, 100.0));
  cli.add_option_function<double>(
         "--voxel-size",
         [&voxels](double size) {
           voxels.rule = VoxelRule::TARGET_SIZE_CLAMPED;
           voxels.target_size = size;
         },
         "Voxel side [m], divisions kept within 10 and 31")
      ->type_name("M")
      ->check(positiveNumber());
  cli.add_option_function<std::vector<int>>(
         "--divisions",
         [&voxels](const std::vector<int>& n) {
           voxels.rule = VoxelRule::DIVISIONS;
           voxels.divisions = Eigen::Vector3i(n[0], n[1], n[2]);
         },
         "Numbers of voxels themselves")
      ->expected(3)
      ->delimiter(',')
      ->type_name("NX,NY,NZ")
      ->check(wholeNumber(1, MAX_DIVISIONS));
  addChoice<PrismRun>(
      cli,
      "--run",
      options.prisms.run,
      {{"cross", PrismRun::CROSS}, {"min", PrismRun::MIN}, {"max", PrismRun::MAX}},
      "How far a prism extends down (the paper's Fig. 4)");
  cli.add_flag("--exclusive",
               options.exclusive_points,
               "A point counts for its smallest prism only");
}

} // namespace

void addModelOptions(CLI::App& cli, ModelOptions& options) {
  cli.set_config("--config", "", "TOML file with options; the command line wins")
      ->type_name("FILE")
      ->check(existingFile());
  cli.add_option("-o,--output", options.output, "Model as JSON; -: standard output")
      ->type_name("FILE");
  addViewOptions(cli, options);
  addTaperOption(cli, options);
  addFitOptions(cli, options.estimation);
  cli.add_option("--roi", options.roi, "Object in the image [px] (organized clouds)")
      ->expected(4)
      ->delimiter(',')
      ->type_name("X,Y,W,H")
      ->check(wholeNumber(-MAX_PIXELS, MAX_PIXELS));
  cli.add_option(
         "--box", options.box, "Object's box, its lowest corner and its highest [m]")
      ->expected(6)
      ->delimiter(',')
      ->type_name("X0,Y0,Z0,X1,Y1,Z1")
      ->check(number(-FARTHEST, FARTHEST));
  cli.add_flag(
      "--remove-plane",
      options.remove_plane,
      "Take the largest thing that stands on a plane of the cloud; with --roi or "
      "--box the thing in it");
  addPrismOptions(cli, options.estimation);
  cli.add_option("--grasp-points",
                 options.grasp_points,
                 "Points on the surface as PCD; -: standard output")
      ->type_name("FILE");
  cli.add_option("--grasp-threshold",
                 options.estimation.grasp_threshold,
                 "Largest |F^(e1/2) - 1| of such a point")
      ->check(positiveNumber(1.0))
      ->capture_default_str();
  addExportOptions(cli, options.exported);
  cli.add_option("--threads", options.threads, "Number of threads, 0: all cores")
      ->check(wholeNumber(0, 1024))
      ->capture_default_str();
#ifdef PCL_SQ_HAVE_VISUALIZATION
  cli.add_option("--mesh",
                 options.mesh,
                 "Surface as .ply, .obj, .stl or .vtp; -: PLY on standard output")
      ->type_name("FILE");
  cli.add_option("--snapshot", options.snapshot, "Picture as PNG; -: standard output")
      ->type_name("FILE");
#endif
}

void checkModelOptions(const ModelOptions& options) {
  std::string why;
  if (!options.estimation.isValid(&why))
    throw UsageError(why + ".");
  if (!options.roi.empty() && (options.roi[2] <= 0 || options.roi[3] <= 0))
    throw UsageError("--roi wants a width and a height above 0: X,Y,W,H.");
  for (std::size_t k = 0; k + 3 < options.box.size(); ++k)
    if (!(options.box[k] < options.box[k + 3]))
      throw UsageError("--box wants each minimum below its maximum: "
                       "minx,miny,minz,maxx,maxy,maxz.");
  checkFrame(options.frame);
  checkTaper(options);
  claimOutput("--output", options.output);
  claimOutput("--mesh", options.mesh, {".ply", ".obj", ".stl", ".vtp"});
  claimOutput("--grasp-points", options.grasp_points);
  claimOutput("--snapshot", options.snapshot, {".png"});
  checkExportOptions(options.exported);
}

} // namespace pcl_sq::app
