# What the libraries rest on; read by this build and, installed, by find_package(nereid).

find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(Threads REQUIRED)
find_package(yaml-cpp REQUIRED)
if(NOT TARGET muparser)
  find_path(MUPARSER_FOLDER muParser.h REQUIRED)
  find_library(MUPARSER_LIBRARY muparser REQUIRED)
  add_library(muparser UNKNOWN IMPORTED)
  set_target_properties(muparser PROPERTIES IMPORTED_LOCATION ${MUPARSER_LIBRARY}
                        INTERFACE_INCLUDE_DIRECTORIES ${MUPARSER_FOLDER})
endif()
if(NEREID_WITH_VTK)
  find_package(VTK QUIET COMPONENTS CommonCore CommonDataModel IOXML)
  if(NOT VTK_FOUND)   # a machine with ParaView's own VTK only
    find_package(VTK REQUIRED COMPONENTS CommonCore CommonDataModel IOXML
                 PATHS /usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/paraview-5.11/vtk)
  endif()
endif()
