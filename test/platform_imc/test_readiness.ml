open Dolphin_imc
open Dolphin_platform_imc
module Mode = Message.Vehicle_state.Op_mode

let report ?(plan = "survey") sent state =
  Some { Plan_report.sent; state = { Message.Plan_control_state.default with state; plan_id = plan } }

let case name expected ?mode ?(error = "") report =
  Alcotest.test_case name `Quick (fun () ->
      Alcotest.(check (option string)) name expected (Readiness.obstacle ~mode ~error report))

let tests =
  ( "readiness",
    [ case "in mode SERVICE" None ~mode:(2., Mode.Service) (report 1. Executing);
      case "READY was sent later than the mode" None ~mode:(1., Mode.Maneuver) (report 2. Ready);
      case "a plan that began after SERVICE" (Some "runs plan survey") ~mode:(1., Mode.Service) (report 2. Executing);
      case "a plan that runs" (Some "runs plan survey") ~mode:(2., Mode.Maneuver) (report 1. Executing);
      case "an error, in its words" (Some "is in mode ERROR: leak") ~mode:(1., Mode.Error) ~error:"leak"
        (report 2. Blocked);
      case "an error without words" (Some "is in mode ERROR") ~mode:(1., Mode.Error) (report 2. Blocked);
      case "old words are not of this mode" (Some "is in mode CALIBRATION") ~mode:(2., Mode.Calibration) ~error:"leak"
        (report 1. Ready);
      case "BLOCKED, the mode being older" (Some "cannot run plans now") ~mode:(1., Mode.Service) (report 2. Blocked);
      case "a vehicle that says no mode" None (report 1. Ready);
      case "its plan is not known" (Some "has not reported its plan state yet") ~mode:(1., Mode.Service) None ] )
