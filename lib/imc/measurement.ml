type kind = { name : string; id : int; read : Message.t -> float option; write : float -> Message.t }

let kinds =
  [ { name = "Temperature"; id = Message.Temperature.id;
      read = (function Temperature m -> Some m.value | _ -> None);
      write = (fun value -> Temperature { value }) };
    { name = "Pressure"; id = Message.Pressure.id;
      read = (function Pressure m -> Some m.value | _ -> None);
      write = (fun value -> Pressure { value }) };
    { name = "Depth"; id = Message.Depth.id;
      read = (function Depth m -> Some m.value | _ -> None);
      write = (fun value -> Depth { value }) };
    { name = "SoundSpeed"; id = Message.Sound_speed.id;
      read = (function Sound_speed m -> Some m.value | _ -> None);
      write = (fun value -> Sound_speed { value }) };
    { name = "WaterDensity"; id = Message.Water_density.id;
      read = (function Water_density m -> Some m.value | _ -> None);
      write = (fun value -> Water_density { value }) };
    { name = "Conductivity"; id = Message.Conductivity.id;
      read = (function Conductivity m -> Some m.value | _ -> None);
      write = (fun value -> Conductivity { value }) };
    { name = "Salinity"; id = Message.Salinity.id;
      read = (function Salinity m -> Some m.value | _ -> None);
      write = (fun value -> Salinity { value }) };
    { name = "RhodamineDye"; id = Message.Rhodamine_dye.id;
      read = (function Rhodamine_dye m -> Some m.value | _ -> None);
      write = (fun value -> Rhodamine_dye { value }) };
    { name = "CrudeOil"; id = Message.Crude_oil.id;
      read = (function Crude_oil m -> Some m.value | _ -> None);
      write = (fun value -> Crude_oil { value }) };
    { name = "FineOil"; id = Message.Fine_oil.id;
      read = (function Fine_oil m -> Some m.value | _ -> None);
      write = (fun value -> Fine_oil { value }) };
    { name = "Turbidity"; id = Message.Turbidity.id;
      read = (function Turbidity m -> Some m.value | _ -> None);
      write = (fun value -> Turbidity { value }) };
    { name = "Chlorophyll"; id = Message.Chlorophyll.id;
      read = (function Chlorophyll m -> Some m.value | _ -> None);
      write = (fun value -> Chlorophyll { value }) };
    { name = "Fluorescein"; id = Message.Fluorescein.id;
      read = (function Fluorescein m -> Some m.value | _ -> None);
      write = (fun value -> Fluorescein { value }) };
    { name = "Phycocyanin"; id = Message.Phycocyanin.id;
      read = (function Phycocyanin m -> Some m.value | _ -> None);
      write = (fun value -> Phycocyanin { value }) };
    { name = "Phycoerythrin"; id = Message.Phycoerythrin.id;
      read = (function Phycoerythrin m -> Some m.value | _ -> None);
      write = (fun value -> Phycoerythrin { value }) };
    { name = "DissolvedOxygen"; id = Message.Dissolved_oxygen.id;
      read = (function Dissolved_oxygen m -> Some m.value | _ -> None);
      write = (fun value -> Dissolved_oxygen { value }) };
    { name = "AirSaturation"; id = Message.Air_saturation.id;
      read = (function Air_saturation m -> Some m.value | _ -> None);
      write = (fun value -> Air_saturation { value }) };
    { name = "PH"; id = Message.Ph.id;
      read = (function Ph m -> Some m.value | _ -> None);
      write = (fun value -> Ph { value }) };
    { name = "Redox"; id = Message.Redox.id;
      read = (function Redox m -> Some m.value | _ -> None);
      write = (fun value -> Redox { value }) } ]

let names = List.map (fun k -> k.name) kinds

let is_id id = List.exists (fun k -> k.id = id) kinds
let of_message message = List.find_map (fun k -> Option.map (fun x -> (k.name, x)) (k.read message)) kinds

let to_message name x =
  Option.map (fun k -> k.write x) (List.find_opt (fun k -> k.name = name) kinds)
