// Functions of GDAL and PROJ, whose libraries are loaded when the first raster needs them. Used in this folder only.
// A program that is linked with GDAL loads some 100 libraries at each start, which takes 0.1 s of processor time.
// Each function is a pointer in this namespace with the name that the header of GDAL or PROJ gives it. So a call in
// this folder looks as if the program were linked with GDAL.
// Errors: a library that the system does not have. Threads: a thread calls load_gdal() before it calls a function.
#pragma once

#include <cpl_conv.h>
#include <cpl_error.h>
#include <cpl_vsi.h>
#include <gdal.h>
#include <ogr_srs_api.h>
#include <proj.h>

#include <string>

#include "lib/error/error.hpp"

// NOLINTBEGIN(cppcoreguidelines-macro-usage,bugprone-macro-parentheses)
// clang-format off
#define YARS_GDAL_FUNCTIONS(F) \
  F(CPLGetErrorHandlerUserData) F(CPLPopErrorHandler) F(CPLPushErrorHandlerEx) F(CPLSetConfigOption) \
  F(GDALAllRegister) F(GDALClose) F(GDALCreate) F(GDALGetDataTypeName) F(GDALGetDatasetDriver) \
  F(GDALGetDriverByName) F(GDALGetDriverShortName) F(GDALGetGeoTransform) F(GDALGetMaskBand) F(GDALGetMaskFlags) \
  F(GDALGetMetadataItem) F(GDALGetRasterBand) F(GDALGetRasterCount) F(GDALGetRasterDataType) \
  F(GDALGetRasterNoDataValue) F(GDALGetRasterOffset) F(GDALGetRasterScale) F(GDALGetRasterUnitType) \
  F(GDALGetRasterXSize) F(GDALGetRasterYSize) F(GDALGetSpatialRef) F(GDALInvGeoTransform) F(GDALOpenEx) \
  F(GDALRasterIO) F(GDALSetDescription) F(GDALSetGeoTransform) F(GDALSetRasterNoDataValue) F(GDALSetSpatialRef) \
  F(OSRDemoteTo2D) F(OSRDestroySpatialReference) F(OSRExportToWktEx) F(OSRGetDataAxisToSRSAxisMapping) \
  F(OSRImportFromProj4) F(OSRNewSpatialReference) F(OSRPromoteTo3D) F(VSIFree) F(VSIGetMemFileBuffer) \
  F(VSIUnlink)
#define YARS_PROJ_FUNCTIONS(F) \
  F(proj_as_wkt) F(proj_context_create) F(proj_context_destroy) F(proj_context_set_enable_network) \
  F(proj_coordoperation_get_accuracy) F(proj_coordoperation_get_grid_used) \
  F(proj_coordoperation_get_grid_used_count) F(proj_coordoperation_has_ballpark_transformation) \
  F(proj_coordoperation_is_instantiable) F(proj_create) F(proj_create_operation_factory_context) \
  F(proj_create_operations) F(proj_crs_get_coordinate_system) F(proj_crs_get_sub_crs) F(proj_cs_get_axis_count) \
  F(proj_cs_get_axis_info) F(proj_cs_get_type) F(proj_destroy) F(proj_get_name) F(proj_get_source_crs) \
  F(proj_get_type) F(proj_is_equivalent_to_with_ctx) F(proj_list_destroy) F(proj_list_get) \
  F(proj_list_get_count) F(proj_log_func) F(proj_operation_factory_context_destroy) \
  F(proj_operation_factory_context_set_allow_ballpark_transformations) \
  F(proj_operation_factory_context_set_area_of_interest) \
  F(proj_operation_factory_context_set_grid_availability_use) \
  F(proj_operation_factory_context_set_spatial_criterion) F(proj_trans_generic)
// clang-format on

namespace yars::model::terrain::gdal {

#define YARS_DECLARE(name) extern decltype(&::name) name;
YARS_GDAL_FUNCTIONS(YARS_DECLARE)
YARS_PROJ_FUNCTIONS(YARS_DECLARE)
#undef YARS_DECLARE
// NOLINTEND(cppcoreguidelines-macro-usage,bugprone-macro-parentheses)

// Loads both libraries at its first call, and sets GDAL up: no files beside the user's, all drivers registered.
// `subject`: what the error is about.
error::Expected<void> load_gdal(const std::string& subject);

}  // namespace yars::model::terrain::gdal
