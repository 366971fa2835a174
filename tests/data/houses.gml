<?xml version="1.0" encoding="UTF-8"?>
<core:CityModel xmlns:core="http://www.opengis.net/citygml/2.0" xmlns:bldg="http://www.opengis.net/citygml/building/2.0"
    xmlns:gml="http://www.opengis.net/gml">
  <gml:boundedBy><gml:Envelope srsName="http://www.opengis.net/def/crs/EPSG/0/6697" srsDimension="3">
    <gml:lowerCorner>35.02352970 135.75014422 0</gml:lowerCorner><gml:upperCorner>35.02385459 135.75048485 6</gml:upperCorner>
  </gml:Envelope></gml:boundedBy>
  <core:cityObjectMember>
    <bldg:Building gml:id="bldg_a">
      <gml:name>角屋</gml:name>
      <bldg:measuredHeight uom="m">5.8</bldg:measuredHeight>
      <bldg:storeysAboveGround>2</bldg:storeysAboveGround>
      <bldg:lod0RoofEdge><gml:MultiSurface><gml:surfaceMember><gml:Polygon>
        <gml:exterior><gml:LinearRing><gml:posList>35.02352970 135.75014521 5.80 35.02352983 135.75020438 5.80 35.02362718 135.75020409 5.80 35.02362706 135.75014491 5.80 35.02352970 135.75014521 5.80</gml:posList></gml:LinearRing></gml:exterior>
      </gml:Polygon></gml:surfaceMember></gml:MultiSurface></bldg:lod0RoofEdge>
    </bldg:Building>
  </core:cityObjectMember>
  <core:cityObjectMember>
    <bldg:Building gml:id="bldg_b">
      <gml:name>米屋</gml:name>
      <bldg:measuredHeight uom="m">5.8</bldg:measuredHeight>
      <bldg:storeysAboveGround>2</bldg:storeysAboveGround>
      <bldg:lod0RoofEdge><gml:MultiSurface><gml:surfaceMember><gml:Polygon>
        <gml:exterior><gml:LinearRing><gml:posList>35.02352983 135.75020438 5.80 35.02352997 135.75027342 5.80 35.02361110 135.75027318 5.80 35.02361096 135.75020414 5.80 35.02352983 135.75020438 5.80</gml:posList></gml:LinearRing></gml:exterior>
      </gml:Polygon></gml:surfaceMember></gml:MultiSurface></bldg:lod0RoofEdge>
    </bldg:Building>
  </core:cityObjectMember>
  <core:cityObjectMember>
    <bldg:Building gml:id="bldg_c">
      <gml:name>鍵屋</gml:name>
      <bldg:measuredHeight uom="m">2.9</bldg:measuredHeight>
      <bldg:storeysAboveGround>1</bldg:storeysAboveGround>
      <bldg:lod0RoofEdge><gml:MultiSurface><gml:surfaceMember><gml:Polygon>
        <gml:exterior><gml:LinearRing><gml:posList>35.02353002 135.75029863 2.90 35.02353018 135.75037753 2.90 35.02357886 135.75037738 2.90 35.02357878 135.75033793 2.90 35.02364369 135.75033773 2.90 35.02364360 135.75029828 2.90 35.02353002 135.75029863 2.90</gml:posList></gml:LinearRing></gml:exterior>
      </gml:Polygon></gml:surfaceMember></gml:MultiSurface></bldg:lod0RoofEdge>
    </bldg:Building>
  </core:cityObjectMember>
  <core:cityObjectMember>
    <bldg:Building gml:id="bldg_d">
      <gml:name>中庭の家</gml:name>
      <bldg:measuredHeight uom="m">2.9</bldg:measuredHeight>
      <bldg:storeysAboveGround>1</bldg:storeysAboveGround>
      <bldg:lod0RoofEdge><gml:MultiSurface><gml:surfaceMember><gml:Polygon>
        <gml:exterior><gml:LinearRing><gml:posList>35.02371000 135.75014466 2.90 35.02371036 135.75032000 2.90 35.02385459 135.75031956 2.90 35.02385423 135.75014422 2.90 35.02371000 135.75014466 2.90</gml:posList></gml:LinearRing></gml:exterior><gml:interior><gml:LinearRing><gml:posList>35.02380026 135.75019918 2.90 35.02380039 135.75026493 2.90 35.02375532 135.75026507 2.90 35.02375518 135.75019932 2.90 35.02380026 135.75019918 2.90</gml:posList></gml:LinearRing></gml:interior>
      </gml:Polygon></gml:surfaceMember></gml:MultiSurface></bldg:lod0RoofEdge>
    </bldg:Building>
  </core:cityObjectMember>
  <core:cityObjectMember>
    <bldg:Building gml:id="bldg_e">
      <gml:name>曲り角</gml:name>
      <bldg:measuredHeight uom="m">2.9</bldg:measuredHeight>
      <bldg:storeysAboveGround>1</bldg:storeysAboveGround>
      <bldg:lod0RoofEdge><gml:MultiSurface><gml:surfaceMember><gml:Polygon>
        <gml:exterior><gml:LinearRing><gml:posList>35.02353475 135.75040820 2.90 35.02355294 135.75048485 2.90 35.02362953 135.75046818 2.90 35.02361135 135.75039701 2.90 35.02353475 135.75040820 2.90</gml:posList></gml:LinearRing></gml:exterior>
      </gml:Polygon></gml:surfaceMember></gml:MultiSurface></bldg:lod0RoofEdge>
    </bldg:Building>
  </core:cityObjectMember>
</core:CityModel>
