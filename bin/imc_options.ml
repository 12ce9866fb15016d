open Cmdliner
open Dolphin_platform_imc

let s_network = "IMC NETWORK"

let imc =
  let doc =
    "Run on the vehicles of the network, which speak IMC over UDP, instead of a simulated fleet. Nothing is simulated: \
     vehicles move."
  in
  Arg.(value & flag & info [ "imc" ] ~docs:s_network ~doc)

let definition =
  let doc =
    "Take unknown names and messages from the definition of IMC in $(docv), as vehicles come with it: $(i,IMC.xml). \
     It is an error if Dolphin's messages differ from it."
  in
  Arg.(value & opt (some string) None & info [ "imc-xml" ] ~docs:s_network ~docv:"FILE" ~doc)

let loopback =
  let doc = "Speak only to vehicles on this machine, over 127.0.0.1. Implies $(b,--imc)." in
  Arg.(value & flag & info [ "imc-loopback" ] ~docs:s_network ~doc)

let address =
  let parse text =
    match Unix.inet_addr_of_string text with
    | address when not (String.contains text ':') -> Ok address
    | _ | (exception Failure _) -> Error (`Msg (Printf.sprintf "'%s' is not an IPv4 address" text))
  in
  Arg.conv ~docv:"ADDRESS" (parse, fun ppf a -> Format.pp_print_string ppf (Unix.string_of_inet_addr a))

let interfaces =
  let doc =
    "Use the network interface that has this address of this machine. May be repeated. By default all are used. \
     Implies $(b,--imc)."
  in
  Arg.(value & opt_all address [] & info [ "imc-interface" ] ~docs:s_network ~docv:"ADDRESS" ~doc)

let port =
  let doc =
    "Have vehicles send to port $(docv) of this machine, for firewalls. By default any free one. Implies $(b,--imc)."
  in
  let ports = Options.between ~docv:"PORT" ~least:1 ~most:65535 "a port" in
  Arg.(value & opt (some ports) None & info [ "imc-port" ] ~docs:s_network ~docv:"PORT" ~doc)

let id =
  let doc =
    "Be the system $(docv) of the network, for example 0x4001. By default an address is drawn for each run, since \
     vehicles forget a console that returns on another port only when they restart. Implies $(b,--imc)."
  in
  let ids = Options.between ~docv:"ID" ~least:0x4000 ~most:0x5FFF "the IMC address of a console" in
  Arg.(value & opt (some ids) None & info [ "imc-id" ] ~docs:s_network ~docv:"ID" ~doc)

let devices =
  let parse text =
    match String.index_opt text '=' with
    | Some i when i > 0 ->
      let names = String.split_on_char ',' (String.sub text (i + 1) (String.length text - i - 1)) in
      Ok (String.sub text 0 i, List.filter (fun name -> name <> "") (List.map String.trim names))
    | Some _ | None -> Error (`Msg (Printf.sprintf "'%s' is not like x8-02=Camera,Sidescan" text))
  in
  let print ppf (vehicle, names) = Format.fprintf ppf "%s=%s" vehicle (String.concat "," names) in
  Arg.conv ~docv:"VEHICLE=DEVICES" (parse, print)

let payload =
  let doc =
    "The payload of a vehicle, as in $(b,--imc-payload noptilus-1=DVL,Sidescan), instead of the one that it reports \
     (the labels of its entities). May be repeated, for one vehicle each. Implies $(b,--imc)."
  in
  Arg.(value & opt_all devices [] & info [ "imc-payload" ] ~docs:s_network ~docv:"VEHICLE=DEVICES" ~doc)

let types =
  let typed =
    let parse text =
      match String.split_on_char '=' text with
      | [ vehicle; kind ] when vehicle <> "" && kind <> "" -> Ok (vehicle, kind)
      | _ -> Error (`Msg (Printf.sprintf "'%s' is not like seacon-1=ROV" text))
    in
    Arg.conv ~docv:"VEHICLE=TYPE" (parse, fun ppf (vehicle, kind) -> Format.fprintf ppf "%s=%s" vehicle kind)
  in
  let doc =
    "Let a vehicle be of another type than it announces, as in $(b,--imc-type seacon-1=ROV): IMC has no type for ROVs. \
     May be repeated. Implies $(b,--imc)."
  in
  Arg.(value & opt_all typed [] & info [ "imc-type" ] ~docs:s_network ~docv:"VEHICLE=TYPE" ~doc)

let ports =
  let parse text =
    match List.map int_of_string_opt (String.split_on_char '-' text) with
    | [ Some first; Some last ] when first >= 1 && first <= last && last <= 65535 && last - first < 100 ->
      Ok (List.init (last - first + 1) (fun i -> first + i))
    | _ -> Error (`Msg (Printf.sprintf "'%s' is not like 30100-30104, a hundred ports at most" text))
  in
  let print ppf ports = Format.fprintf ppf "%d-%d" (List.hd ports) (List.hd (List.rev ports)) in
  Arg.conv ~docv:"FIRST-LAST" (parse, print)

let discovery_ports =
  let doc =
    "The ports on which systems announce themselves. By default those of vehicles, 30100-30104. Implies $(b,--imc)."
  in
  Arg.(value & opt (some ports) None & info [ "imc-discovery-ports" ] ~docs:s_network ~docv:"FIRST-LAST" ~doc)

let abort =
  let doc =
    "Send an Abort to a vehicle that still reports MANEUVER 3 s after an order to stop, and then once a second: the \
     last resort if its plan engine has lost the plan. An Abort also ends plans that others run on it. Implies \
     $(b,--imc)."
  in
  Arg.(value & flag & info [ "imc-abort" ] ~docs:s_network ~doc)

let make loopback interfaces port discovery id payload types abort =
  let options = Udp_platform.default in
  { options with
    loopback; interfaces; id; payload; types; abort;
    data_port = Option.value port ~default:options.data_port;
    announce_ports = Option.value discovery ~default:options.announce_ports }

let options = Term.(const make $ loopback $ interfaces $ port $ discovery_ports $ id $ payload $ types $ const false)

let chosen =
  let choose imc definition loopback interfaces port discovery id payload types abort =
    let implied =
      definition <> None || loopback || interfaces <> [] || port <> None || discovery <> None || id <> None
      || payload <> [] || types <> [] || abort
    in
    if imc || implied then Some (make loopback interfaces port discovery id payload types abort) else None
  in
  Term.(
    const choose $ imc $ definition $ loopback $ interfaces $ port $ discovery_ports $ id $ payload $ types
    $ abort)

let with_names definition options =
  match definition with
  | None -> options
  | Some d -> { options with Udp_platform.type_names = Compatibility.types d }
