// SPDX-License-Identifier: GPL-3.0-or-later
// Tables as rovers, offices and spreadsheets export them: what each column means, and in what unit.
#include <gtest/gtest.h>

#include <algorithm>

#include "reconstruction/exchange/read_survey_file.h"
#include "tests/reconstruction/exchange/text_files.h"

namespace insitu {
namespace {

using Eigen::Vector3d;

class HeaderTable : public TextFiles {
 protected:
  SurveyFile Read(const std::string& text) const {
    return ReadSurveyFile(
        Write("t.csv", text), [](const auto&) { return std::nullopt; }, reading_);
  }
  SurveyedPoint OnePoint(const std::string& text) const {
    const SurveyFile file = Read(text);
    EXPECT_EQ(file.points.size(), 1u) << text;
    return file.points.empty() ? SurveyedPoint{} : file.points[0];
  }
  void ExpectRefused(const std::string& text, const std::string& why, int line = 1) const {
    ExpectError([&] { Read(text); }, "t.csv", line, why);
  }
  static bool Says(const SurveyFile& file, const std::string& words) {
    return std::any_of(file.remarks.begin(), file.remarks.end(), [&](const auto& remark) {
      return remark.text().find(words) != std::string::npos;
    });
  }

  SurveyReading reading_;
};

TEST_F(HeaderTable, ALineOfUnitsBelowTheTitlesCounts) {
  EXPECT_EQ(OnePoint("Name,E,N,H\n,[mm],[mm],(m)\np,1500,2500,3\n").position,
            Vector3d(1.5, 2.5, 3));
  EXPECT_EQ(OnePoint("P,N,E,Z\n,m,m,m\nq,2,1,3\n").position, Vector3d(1, 2, 3));
}

TEST_F(HeaderTable, TwoSystemsInOneTableAreRefused) {
  ExpectRefused("Name,E,N,H,CRS\na,1,2,3,EPSG:25832\nb,1,2,3,EPSG:25832\nc,1,2,3,EPSG:31468\n",
                "\"EPSG:25832\" in line 2: two coordinate systems", 4);
  EXPECT_EQ(OnePoint("Name,E,N,H,CS name\na,1,2,3,LV95\n").position, Vector3d(1, 2, 3));
}

TEST_F(HeaderTable, GridAndPlainCoordinatesAreAQuestion) {
  ExpectRefused("Name,Easting,Northing,Grid Northing,Height\na,1,2,3,4\n",
                "\"Northing\", \"Grid Northing\" are all north");
  EXPECT_EQ(OnePoint("Name,Grid Easting,Grid Northing,Height\na,1,2,3\n").position,
            Vector3d(1, 2, 3));
}

TEST_F(HeaderTable, UnitsOfTheTitlesAreConverted) {
  const double us = 1200.0 / 3937;
  EXPECT_LT(
      (OnePoint(
           "Point,Easting (US ft),Northing (US survey feet),Elevation [usft]\np,3937,7874,39.37\n")
           .position -
       Vector3d(1200, 2400, 12))
          .norm(),
      1e-9);
  EXPECT_LT(
      (OnePoint("Name,X [mm],Y [mm],Z [mm]\np,1500,2500,3500\n").position - Vector3d(1.5, 2.5, 3.5))
          .norm(),
      1e-12);
  EXPECT_LT((OnePoint("Name,Easting_ift,Northing_ift,Height_ift\np,10,20,30\n").position -
             0.3048 * Vector3d(10, 20, 30))
                .norm(),
            1e-12);
  EXPECT_LT((OnePoint("Name;E in cm;N in cm;H in cm\np;1,5;2,5;3,5\n").position -
             Vector3d(0.015, 0.025, 0.035))
                .norm(),
            1e-12);
  EXPECT_EQ(OnePoint("Nr;H\xC3\xB6he [m \xC3\xBC. M.];Rechtswert;Hochwert\np;400,5;600000;200000\n")
                .position,
            Vector3d(600000, 200000, 400.5));
  reading_.unit = "US survey feet";
  EXPECT_LT(
      (OnePoint("Name,X,Y,Z (m)\np,100,200,7\n").position - Vector3d(100 * us, 200 * us, 7)).norm(),
      1e-9);
  EXPECT_LT(
      (OnePoint("Name,X (ft),Y (ft),Z (ft)\np,100,200,7\n").position - us * Vector3d(100, 200, 7))
          .norm(),
      1e-9);
}

TEST_F(HeaderTable, UnitsThatLeaveItOpenAreRefused) {
  ExpectRefused("Name,X (ft),Y (ft),Z (ft)\np,1,2,3\n", "in feet, of which there are two");
  ExpectRefused("Name,X [chain],Y [chain],Z [m]\np,1,2,3\n", "[chain] is none that we know");
  ExpectRefused("Name,Easting (gon),Northing (gon),Z\np,1,2,3\n", "expected a length");
  ExpectRefused("photo,point,x [mm],y [mm]\na.jpg,p,1,2\n", "expected pixels");
  ExpectRefused("photo,point,x (normalised),y (normalised)\na.jpg,p,0.1,0.2\n", "expected pixels");
  ExpectRefused("photo,point,x,y\na.jpg,p,0.1,0.2\na.jpg,q,0.3,0.2\na.jpg,r,0.1,0.9\n",
                "shares of the picture", 2);
  reading_.unit = "furlong";
  EXPECT_THROW(Read("Name,X,Y,Z\np,1,2,3\n"), InputError);
}

TEST_F(HeaderTable, AccuraciesInTheirOwnUnits) {
  EXPECT_EQ(*OnePoint("Name,E,N,H,Accuracy (cm)\np,1,2,3,1.5\n").sigma, Vector3d::Constant(0.015));
  EXPECT_EQ(*OnePoint("Name,E,N,H,Std E [mm],Std N [mm],Std H [mm]\np,1,2,3,5,5,8\n").sigma,
            Vector3d(0.005, 0.005, 0.008));
  EXPECT_EQ(
      *OnePoint("Point ID,Easting,Northing,Ortho Height,H RMS,V RMS\np,1,2,3,0.01,0.02\n").sigma,
      Vector3d(0.01, 0.01, 0.02));
  EXPECT_EQ(*OnePoint("Point,N,E,Elev,HRMS,VRMS\np,2,1,3,0.01,0.02\n").sigma,
            Vector3d(0.01, 0.01, 0.02));
  EXPECT_EQ(*OnePoint("Point ID;East;North;Height;2D CQ;1D CQ\np;1;2;3;0,01;0,02\n").sigma,
            Vector3d(0.01, 0.01, 0.02));
  ExpectRefused("Name,E,N,H,Accuracy 95% (m)\np,1,2,3,1.5\n", "limits of a confidence");
}

const char kEmlid[] =
    "Name,Code,Easting,Northing,Elevation,Description,Longitude,Latitude,Ellipsoidal "
    "height,Origin,Easting RMS,Northing "
    "RMS,Elevation RMS,Lateral RMS,Antenna height,Antenna height units,Solution status,Base "
    "easting,CS name\n"
    "1,,30000.321,200000.920,700.500,,15.7639,49.4102,802.732,Global,0.230,0.210,0.571,0.312,1.945,"
    "m,SINGLE,5,MGI\n";

TEST_F(HeaderTable, OfARoverThatExportsBothSystems) {
  const SurveyFile file = Read(kEmlid);
  ASSERT_EQ(file.points.size(), 1u);
  EXPECT_EQ(file.points[0].name, "1");
  EXPECT_EQ(file.points[0].position, Vector3d(30000.321, 200000.920, 700.5));
  EXPECT_EQ(*file.points[0].sigma, Vector3d(0.23, 0.21, 0.571));
  EXPECT_FALSE(file.has_degrees);
  EXPECT_TRUE(Says(file, "Longitude, Latitude, Ellipsoidal height"));
}

TEST_F(HeaderTable, TwoColumnsOfOneQuantityAreAQuestion) {
  const std::string table =
      "Name,Easting,Northing,Ellipsoidal height,Orthometric height\np,1,2,47,3\n";
  ExpectRefused(table, "which is meant");
  reading_.columns["height"] = "Orthometric height";
  EXPECT_EQ(OnePoint(table).position.z(), 3);
  reading_.columns.clear();
  ExpectRefused("Name,X,Y,Z,Easting,Northing\np,1,2,3,4,5\n", "which is meant");
  ExpectRefused("Name,Y,X,H\np,600000,200000,400\n", "which is east");
  reading_.columns = {{"east", "Y"}, {"north", "X"}};
  EXPECT_EQ(OnePoint("Name,Y,X,H\np,600000,200000,400\n").position, Vector3d(600000, 200000, 400));
  reading_.columns.clear();
  ExpectRefused("Name,Easting,Northing,Antenna height\np,1,2,1.9\n", "no column is the height");
}

TEST_F(HeaderTable, AnglesInDegreesMinutesSecondsAndGon) {
  const double latitude = 47 + 22 / 60.0 + 18.5 / 3600, longitude = 8 + 30 / 60.0;
  for (const std::string row : {"p,8\xC2\xB0"
                                "30'00\"E,47\xC2\xB0"
                                "22'18.5\"N,400",
                                "p,8 30 0,47 22 18.5,400", "p,E8:30,N47:22:18.5,400"}) {
    const SurveyFile file = Read("Name,Longitude,Latitude,Altitude\n" + row + "\n");
    EXPECT_TRUE(file.has_degrees);
    EXPECT_LT((file.points[0].position - Vector3d(longitude, latitude, 400)).norm(), 1e-12) << row;
  }
  EXPECT_NEAR(OnePoint("Name,Lon,Lat,H\np,8 30 0 W,1 0 0 S,4\n").position.y(), -1, 1e-12);
  EXPECT_NEAR(OnePoint("Name,Lon [gon],Lat [gon],H\np,10,50,4\n").position.y(), 45, 1e-12);
  ExpectRefused("Name,Lon,Lat,H\np,8 61 0,47 0 0,4\n", "finite number", 2);
}

TEST_F(HeaderTable, TitlesOfFourLanguages) {
  for (const std::string titles :
       {"Name;Rechtswert;Hochwert;H\xC3\xB6he", "Punktnummer;Ost;Nord;Hoehe",
        "Nom;Est;Nord;Altitude", "Punto;Est;Nord;Quota", "Point ID;Easting;Northing;Elevation",
        "Matricule;X;Y;Z", "N\xC2\xB0;E;N;H", "Pkt-Nr.;E [m];N [m];H [m]",
        "POINT_ID;POINT_X;POINT_Y;POINT_Z"}) {
    EXPECT_EQ(OnePoint(titles + "\n7;1,5;2,5;3,5\n").position, Vector3d(1.5, 2.5, 3.5)) << titles;
  }
}

TEST_F(HeaderTable, NamesAreNoNumbersThoughTheyLookLikeThem) {
  EXPECT_EQ(OnePoint("Name;X;Y;Z\n1,5;1,5;2,5;3,5\n").name, "1,5");
  EXPECT_EQ(OnePoint("Name,X,Y,Z\n007,1,2,3\n").name, "007");
}

}  // namespace
}  // namespace insitu
